"""Runs against the command line: the same columns, the same summary, the same refusals."""

import csv
import json
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import kontur
import numpy as np
import pyarrow.parquet
import pytest
from conftest import PROGRAMS, ROOT, SQUARE

SIGNALS = "time,path,ipo,set,kin,err,ctrl,drive,axis,spindle"
SAMPLES = ["square_corner.nc", "late_braking.nc", "feedhold_and_override.nc", "arc_and_helix.nc"]


def printed(column, decimals):
    """A column as the command line prints it; a zero has no sign."""
    if decimals is None:
        masked = np.ma.getmaskarray(column)
        return ["" if missing else str(value) for value, missing in zip(column, masked)]
    texts = (f"{value:.{decimals}f}" for value in column)
    return [text.lstrip("-") if float(text) == 0 else text for text in texts]


@pytest.mark.parametrize("name", [name for name in SAMPLES if (PROGRAMS / name).exists()])
def test_columns_are_those_of_the_csv(command, tmp_path, name):
    trace = tmp_path / "a.csv"
    said = command("run", PROGRAMS / name, "-o", trace, "--signals", SIGNALS, "--summary", "json")
    assert said.returncode == 0, said.stderr
    run = kontur.run(PROGRAMS / name, signals=SIGNALS)
    with trace.open(newline="") as file:
        header, *rows = csv.reader(file)
    assert list(run.columns) == list(run) == header
    assert len(run) == len(rows)
    for i, column in enumerate(header):
        texts = [row[i] for row in rows]
        words = run[column].dtype.kind == "U" or column in ("line", "block")
        digits = None if words else len(texts[0].partition(".")[2])
        assert printed(run[column], digits) == texts, column
    assert run.summary == json.loads(said.stdout)
    assert run.units["X_acc_mm_s2"] == "mm/s2" and run.units["S_vel_deg_s"] == "deg/s"
    assert set(run.units) == set(header)


def test_columns_are_those_of_parquet_bit_by_bit(command, tmp_path):
    trace = tmp_path / "a.parquet"
    said = command("run", SQUARE, "-o", trace, "--signals", SIGNALS)
    if "without Parquet" in said.stderr:
        pytest.skip("the command line was built without Parquet")
    assert said.returncode == 0, said.stderr
    table = pyarrow.parquet.read_table(trace)
    run = kontur.run(SQUARE, signals=SIGNALS)
    arrow = run.to_arrow()
    assert arrow.column_names == table.column_names
    for name in table.column_names:
        theirs, ours = table[name].combine_chunks(), arrow[name].combine_chunks()
        if theirs.type == "double":
            # bits: a zero with a sign is another one, and so is every NaN
            assert np.array_equal(
                theirs.to_numpy().view(np.int64), ours.to_numpy().view(np.int64)
            ), name
        else:
            assert theirs.to_pylist() == ours.to_pylist(), name


def test_frames_hold_the_columns():
    run = kontur.run(SQUARE)
    pandas, polars = run.to_pandas(), run.to_polars()
    assert list(pandas.columns) == list(polars.columns) == list(run.columns)
    for frame in (pandas, polars):
        assert np.array_equal(frame["X_set_mm"].to_numpy(), run["X_set_mm"])
        assert list(frame["v_limit"]) == list(run["v_limit"])
    assert pandas["block"].isna().tolist() == np.ma.getmaskarray(run["block"]).tolist()
    assert pandas["block"].dropna().tolist() == run["block"].compressed().tolist()


def test_numbers_are_not_copied():
    run = kontur.run(SQUARE)
    column = run["X_set_mm"]
    assert column is run["X_set_mm"] and not column.flags.owndata
    assert np.shares_memory(column, run.to_arrow()["X_set_mm"].chunk(0).to_numpy())


def test_options_mean_what_they_mean_on_the_command_line(command, program, tmp_path):
    part = program("/1 N10 G01 X5 F100\nN20 G01 F3000 X[10+V.E.More]\nN30 G04 X0.1\nN40 M30\n")
    hold = tmp_path / "hold.csv"
    hold.write_text("t_s,feedhold\n0.05,1\n0.1,0\n")
    trace = tmp_path / "a.csv"
    words = "--set X.getriebe[0].kv=4000 --cycle-us 2000 --start X1,Y-2.5 --skip 1 --external More=1.5 --decimate 3"
    said = command("run", part, "-o", trace, "--summary", "json", "--input", hold, *words.split())
    assert said.returncode == 0, said.stderr
    run = kontur.run(
        part,
        settings={"X.getriebe[0].kv": 4000},
        cycle_us=2000,
        start={"X": 1, "Y": np.float64(-2.5)},
        skip=[1],
        external={"More": 1.5},
        input=hold,
        decimate=3,
    )
    assert run.summary == json.loads(said.stdout)
    rows = trace.read_text().splitlines()
    assert len(run) == len(rows) - 1
    assert f"{run['X_act_mm'][-1]:.7f}" in rows[-1]
    # settings as text, and machines by their folder
    machine = PROGRAMS / "machines" / "vendor_defaults"
    other = kontur.run(
        part, machine=machine, settings=["X.getriebe[0].kv=4000"], external={"More": "0"}
    )
    assert other.summary["machine"] != run.summary["machine"]


def test_subroutines_name_their_file(program):
    main = program("N10 G01 X1 F1000\nL sub.nc\nN20 M30\n")
    program("N10 G01 Y1\nM17\n", "sub.nc")
    run = kontur.run(main)
    files = run["file"]
    assert {Path(name).name for name in files} == {"part.nc", "sub.nc"}
    assert set(run["line"][[name.endswith("sub.nc") for name in files]]) <= {1, 2}


def test_cycles_one_by_one_are_the_columns():
    run = kontur.run(SQUARE, signals=SIGNALS)
    cycles = list(kontur.start(SQUARE, signals=SIGNALS))
    assert len(cycles) == len(run)
    for name, column in run.columns.items():
        values = [cycle[name] for cycle in cycles]
        expected = [None if value is np.ma.masked else value for value in column]
        assert values == expected, name


def test_run_until_cuts_without_a_trace(program):
    part = program("N10 G01 X1 F600\nN20 Y1\nN30 X0\nN40 M30\n")
    whole = kontur.run(part)
    simulation = kontur.start(part)
    first = simulation.run_until(line=2)
    # the first cycle of the line, and no more
    assert first["line"][-1] == 2 and 2 not in first["line"][:-1]
    second = simulation.run_until(time_s=0.15)
    assert second["t_s"][-1] == 0.15
    assert len(simulation.run_until(time_s=0.15)) == 0
    rest = simulation.run_until(line=99)
    assert simulation.is_over and len(simulation.run_until()) == 0
    for name, column in whole.columns.items():
        joined = np.ma.concatenate([part[name] for part in (first, second, rest)])
        assert np.array_equal(np.ma.filled(joined, -1), np.ma.filled(column, -1)), name
    assert rest.summary == whole.summary


def test_runs_are_as_fresh_as_in_a_new_process(program):
    """After other programs, machines and errors, and beside each other in threads."""
    text = "import kontur, hashlib, sys; r = kontur.run(sys.argv[1], signals='path,set,err,axis')\n"
    text += "print(hashlib.sha256(b''.join(c.tobytes() for n, c in r.columns.items() if n.endswith('mm'))).hexdigest())"
    fresh = subprocess.run(
        [sys.executable, "-c", text, str(SQUARE)], capture_output=True, text=True, check=True
    ).stdout.strip()
    import hashlib

    def digest():
        run = kontur.run(SQUARE, signals="path,set,err,axis")
        columns = (c.tobytes() for n, c in run.columns.items() if n.endswith("mm"))
        return hashlib.sha256(b"".join(columns)).hexdigest()

    kontur.run(
        program("N10 G01 X1 F1000\nM30\n"), machine=PROGRAMS / "machines" / "rack_and_pinion"
    )
    with pytest.raises(kontur.ProgramError):
        kontur.run(program("G7\n"))
    assert digest() == fresh
    found = []
    threads = [threading.Thread(target=lambda: found.append(digest())) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [fresh] * 4


def test_the_interpreter_lock_is_released(program):
    part = program("$FOR P1=0,200,1\nG01 X1 F600\nX0\n$ENDFOR\nM30\n")
    counted = 0
    thread = threading.Thread(target=lambda: kontur.run(part, signals="X_set_mm"))
    thread.start()
    while thread.is_alive():
        counted += 1
        time.sleep(0)
    # with the lock held there would be no turn at all
    assert counted > 10


@pytest.mark.skipif(os.name == "nt", reason="signals")
@pytest.mark.parametrize(
    "text",
    [
        "N10 G01 X50 F0.1\nN20 M30\n",  # one block without end: the cycles are stopped
        "P1=0\n$WHILE 1\nP1=P1+1\n$ENDWHILE\nM30\n",  # no motion: the check ahead is stopped
    ],
)
def test_ctrl_c_stops_what_is_long(program, text):
    part = program(text)
    script = textwrap.dedent(
        f"""
        import kontur, sys
        print("go", flush=True)
        try:
            kontur.run({str(part)!r}, signals="X_set_mm", max_time=1e9)
        except KeyboardInterrupt:
            # and the next one runs
            print("stopped", len(kontur.run({str(SQUARE)!r})))
        """
    )
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "go\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert out.startswith("stopped ") and process.returncode == 0


def test_memory_stays_flat():
    psutil = pytest.importorskip("psutil")
    process = psutil.Process()

    def used():
        for _ in range(40):
            kontur.run(SQUARE)
            kontur.check(SQUARE)
        return process.memory_info().rss

    used()
    before = used()
    after = max(used() for _ in range(3))
    # a run holds 250 kB of columns: 120 of them kept would be 30 MB
    assert after - before < 10e6


def test_examples_run(tmp_path):
    for script in (ROOT / "interpreter" / "python" / "examples").glob("*.py"):
        done = subprocess.run(
            [sys.executable, str(script)], cwd=ROOT, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        assert done.stdout
