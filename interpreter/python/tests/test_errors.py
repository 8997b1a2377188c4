"""Everything wrong raises, with what the command line says about it."""

import json
import pickle

import kontur
import pytest
from conftest import PROGRAMS, SQUARE


def said(completed):
    """Diagnostics of the command line, which prints them as JSON."""
    lines = map(json.loads, completed.stderr.splitlines())
    return [line for line in lines if "kontur_id" in line]


@pytest.mark.parametrize(
    "text",
    [
        "N10 G01 X10\nN20 M30\n",  # no feed
        "N10 G7\nN20 G01 X\nN30 M30\n",  # several
        "N10 G01 X5000 F1000\nM30\n",  # software limit
        "N10 L nowhere.nc\nM30\n",
        "N10 G01 X[1 F100\nM30\n",
        "\0",
        "",
    ],
)
def test_a_refused_program_raises_its_diagnostics(command, program, text):
    part = program(text)
    theirs = said(command("run", part, "--diagnostics", "json"))
    code = command("run", part).returncode
    if code == 0:
        kontur.run(part)
        return
    with pytest.raises(kontur.ProgramError) as caught:
        kontur.run(part)
    error = caught.value
    assert [d.details for d in error.diagnostics] == [d for d in theirs if d["severity"] == "error"]
    assert len(error.run) == 0 and error.run.summary["state"] == "aborted"
    first = error.diagnostics[0]
    assert first.is_error and first.file == str(part) and first.line >= 1 and first.column >= 1
    assert first.id in str(first) and first.text in str(error)
    # what one by one shows the same
    with pytest.raises(kontur.ProgramError):
        next(kontur.start(part))
    # check reports, it does not raise
    assert [d.details for d in kontur.check(part)] == theirs


def test_a_diagnostic_has_its_parts(program):
    (found,) = [d for d in kontur.check(program("N10 G01 X10\nN20 M30\n")) if d.is_error]
    assert (found.id, found.severity, found.line) == ("20008", "error", 1)
    assert (
        found.column >= 1
        and found.hint
        and found.text
        and found.rendered.startswith("error[20008]")
    )
    assert kontur.check(SQUARE) == []


def test_an_aborted_run_keeps_its_rows(program):
    part = program("$WHILE 1\nG01 X1 F600\nX0\n$ENDWHILE\nM30\n")
    with pytest.raises(kontur.ProgramError) as caught:
        kontur.run(part, max_time=0.5)
    run = caught.value.run
    assert [d.id for d in caught.value.diagnostics] == ["K-0017"]
    assert run["t_s"][-1] >= 0.49 and run.summary["state"] == "aborted"
    cycles = kontur.start(part, max_time=0.5)
    count = 0
    with pytest.raises(kontur.ProgramError):
        for _ in cycles:
            count += 1
    assert count == len(run)


@pytest.mark.parametrize(
    "arguments",
    [
        {"cycle_us": 0},
        {"cycle_us": "fast"},
        {"max_time": -1},
        {"max_time": float("nan")},
        {"max_blocks": 0},
        {"skip": [11]},
        {"start": {"Q": 1}},
        {"start": {"X": "far"}},
        {"start": {"X": float("inf")}},
        {"path": "/nowhere/at/all"},
        {"external": {"": 1}},
        {"settings": {"X": 1}},
        {"settings": ["X.getriebe[0].kv"]},
        {"signals": "X_foo_mm"},
        {"decimate": 0},
        {"decimate": -1},
        {"decimate": 2**64},
        {"diagnostics": "json"},
        {"frobnicate": True},
    ],
)
def test_wrong_options_raise(arguments):
    with pytest.raises(kontur.UsageError) as caught:
        kontur.run(SQUARE, **arguments)
    assert isinstance(caught.value, ValueError) and str(caught.value)


@pytest.mark.parametrize(
    "stretch", [{"line": 0}, {"line": -1}, {"line": 2**32}, {"time_s": float("nan")}]
)
def test_wrong_stretches_raise(stretch):
    with pytest.raises(kontur.UsageError):
        kontur.start(SQUARE).run_until(**stretch)


def test_wrong_types_raise():
    for arguments in (
        {"settings": "X.a=1"},
        {"max_time": object()},
        {"decimate": 1.5},
        {"signals": 3},
    ):
        with pytest.raises(TypeError):
            kontur.run(SQUARE, **arguments)


@pytest.mark.parametrize(
    ("settings", "strict"),
    [
        ({"Q.getriebe[0].kv": 1}, False),
        ({"X.no.such.key": 1}, True),
        ({"X.getriebe[0].kv": "much"}, False),
        ({"channel.no.key": 1}, True),
    ],
)
def test_wrong_lists_raise_what_the_command_line_says(command, settings, strict):
    words = [f"--set={key}={value}" for key, value in settings.items()] + ["--strict"] * strict
    theirs = command("run", SQUARE, "--diagnostics", "json", *words)
    if theirs.returncode == 0:
        kontur.run(SQUARE, settings=settings, strict=strict)
        return
    with pytest.raises(kontur.ListsError) as caught:
        kontur.run(SQUARE, settings=settings, strict=strict)
    assert [d.details for d in caught.value.diagnostics] == said(theirs)


def test_wrong_inputs_raise(tmp_path):
    file = tmp_path / "hold.csv"
    file.write_text("t_s,feedhold\n0,7\n")
    with pytest.raises(kontur.InputsError) as caught:
        kontur.run(SQUARE, input=file)
    (found,) = caught.value.diagnostics
    assert (found.id, found.line, found.column, found.file) == ("K-0076", 2, 3, str(file))


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        kontur.run(tmp_path / "nowhere.nc")
    assert caught.value.filename == str(tmp_path / "nowhere.nc")
    with pytest.raises(OSError):
        kontur.run(tmp_path)
    with pytest.raises(OSError):
        kontur.run(SQUARE, input=tmp_path / "nowhere.csv")
    with pytest.raises(kontur.ListsError):
        kontur.run(SQUARE, machine=tmp_path / "nowhere")
    with pytest.raises(OSError):
        kontur.run("-")


def test_exceptions_travel(program):
    """Between processes, as engines send them."""
    with pytest.raises(kontur.Error) as caught:
        kontur.run(program("G01 X10\nM30\n"))
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is kontur.ProgramError
    assert again.diagnostics == caught.value.diagnostics and str(again) == str(caught.value)
    assert again.run.summary == caught.value.run.summary


def test_another_machine_is_another_machine():
    lists = PROGRAMS / "machines" / "xyz"
    ours = kontur.run(SQUARE, machine=lists / "hochlauf.lis")
    assert (ours["X_set_mm"] == kontur.run(SQUARE)["X_set_mm"]).all()
