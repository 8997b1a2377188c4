"""explain, response and tune against the command line."""

import csv
import io

import kontur
import numpy as np
import pytest
from conftest import SQUARE


def test_explain(command):
    for thing in ["22060", "P-AXIS-00571", "#VIB GUARD", "getriebe[0].kv"]:
        assert kontur.explain(thing) == command("explain", thing).stdout
    with pytest.raises(kontur.UsageError, match="VIB GUARD"):
        kontur.explain("#VIB GARD")


@pytest.mark.parametrize(
    ("words", "arguments"),
    [
        (
            "--filter LOWPASS --prototype BESSEL,BUTTERWORTH --order 2,4 --f0 15 --range 1..100",
            {
                "filter": "LOWPASS",
                "prototype": ["BESSEL", "BUTTERWORTH"],
                "order": [2, 4],
                "f0": 15,
                "range": (1, 100),
            },
        ),
        ("--guard MODE=2,FREQ=40 --step", {"guard": {"MODE": 2, "FREQ": 40}, "step": True}),
        (
            "--guard MODE=2,FREQ=40 --guard MODE=1 --residual --damping 0.05,0.1",
            {
                "guard": ["MODE=2,FREQ=40", {"MODE": 1}],
                "residual": True,
                "damping": [0.05, 0.1],
            },
        ),
        ("--hsc-mean 2..20:2 --corner F1000", {"hsc_mean": "2..20:2", "corner": 1000}),
        (
            "--axis X --set X.vib_guard.active=1 --cycle-us 500",
            {"axis": "X", "settings": {"X.vib_guard.active": 1}, "cycle_us": 500},
        ),
    ],
)
def test_responses_are_the_tables_of_the_command_line(command, words, arguments):
    said = command("response", *words.split())
    assert said.returncode == 0, said.stderr
    header, *rows = csv.reader(io.StringIO(said.stdout))
    table = kontur.response(**arguments)
    assert list(table.columns) == header and len(table) == len(rows)
    for i, name in enumerate(header):
        texts = [row[i] for row in rows]
        if name == "curve":
            assert list(table[name]) == texts
            continue
        for text, value in zip(texts, table[name]):
            if text == "":
                assert np.isnan(value), name
            else:
                assert (
                    abs(float(text) - value) <= 0.5 * 10.0 ** -len(text.partition(".")[2]) * 1.001
                )


def test_wrong_responses_raise():
    for arguments in [
        {},
        {"filter": "MAGIC"},
        {"guard": "MODE=9"},
        {"filter": "LOWPASS", "residual": True},
        {"filter": "LOWPASS", "order": "x"},
        {"axis": "Q"},
        {"step": True, "residual": True, "guard": "MODE=1"},
    ]:
        with pytest.raises(kontur.UsageError):
            kontur.response(**arguments)
    with pytest.raises(kontur.ListsError) as caught:
        kontur.response(axis="X", settings={"Q.a.b": 1})
    assert caught.value.diagnostics


def test_tuning_is_what_the_command_line_prints(command):
    words = "--freq 6.9,6.0,5.4 --damping 0.1 --max-dev 0.01"
    tuning = kontur.tune(freq=[6.9, 6.0, 5.4], damping=0.1, max_dev=0.01)
    assert tuning.text == command("tune", *words.split()).stdout
    assert tuning.command in tuning.text and tuning.command.startswith("#VIB GUARD ON [MODE=2")
    kept = tuning["keeps"] == 1
    assert kept.any() and (tuning["residual_ratio"][kept] <= 0.05).all()


def test_tuning_on_a_program(command):
    words = ["--freq", "40", "--program", SQUARE, "--max-dev", "0.03"]
    tuning = kontur.tune(freq=40, program=SQUARE, max_dev=0.03)
    assert tuning.text == command("tune", *words).stdout
    assert (tuning["dev_mm"][tuning["keeps"] == 1] <= 0.03 + 1e-9).all()


def test_orders(command):
    tuning = kontur.tune(order_for=0.1, feed="F2000")
    assert tuning.text == command("tune", "--order-for", "0.1", "--feed", "F2000").stdout
    assert (tuning["contour_err_mm"] <= 0.1).all() and tuning.command is None


def test_recordings(tmp_path):
    """A decay of 20 Hz and damping 0.05 that was written down."""
    t = np.arange(4000) / 2000.0
    omega = 2 * np.pi * 20.0
    a = np.exp(-0.05 * omega * t) * np.cos(omega * np.sqrt(1 - 0.05**2) * t)
    file = tmp_path / "a.csv"
    file.write_text("t_s,a\n" + "\n".join(f"{x:.6f},{y:.9f}" for x, y in zip(t, a)))
    tuning = kontur.tune(recording=file, column="a", range=(5, 100))
    assert "20.0" in tuning.text and "0.05" in tuning.text
    with pytest.raises(FileNotFoundError):
        kontur.tune(recording=tmp_path / "nowhere.csv")
    with pytest.raises(kontur.UsageError):
        kontur.tune()
