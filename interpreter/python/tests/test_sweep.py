"""Sweeps: here, on a cluster that loses a worker, and in shards; always the table of the command line."""

import csv
import io
import os
import subprocess
import sys
import time

import kontur
import numpy as np
import pyarrow.dataset
import pytest
from conftest import SQUARE
from kontur import _sweep
from kontur._words import text_of

GRID = {"X,Y.getriebe[0].kv": [2000, 3000, 4000], "program[7].FREQ": [20, 27.5, "40"]}
WORDS = ["--vary", "X,Y.getriebe[0].kv=2000,3000,4000", "--vary", "program[7].FREQ=20,27.5,40"]


def equals(table, text):
    """A table and the CSV of the command line."""
    header, *rows = csv.reader(io.StringIO(text))
    assert list(table.columns) == header
    assert len(table) == len(rows)
    for i, name in enumerate(header):
        for value, cell in zip(table[name], (row[i] for row in rows)):
            if cell == "":
                assert value == "" or np.isnan(value), name
            elif table[name].dtype.kind == "U":
                assert value == cell, name
            else:
                # half a unit of the last digit
                assert abs(value - float(cell)) <= 0.501 * 10.0 ** -len(cell.partition(".")[2]), (
                    name
                )


def test_numbers_have_no_exponent():
    """A text with an exponent would be a word in the table of the sweep."""
    texts = {1e-7: "0.0000001", 1e22: "1" + "0" * 22, 0.1: "0.1", -2.5: "-2.5", 3: "3"}
    assert {number: text_of(number) for number in texts} == texts


def same(a, b):
    assert a == b
    assert list(a.columns) == list(b.columns)
    for name, column in a.columns.items():
        bits = (c.view(np.int64) if c.dtype.kind == "f" else c for c in (column, b[name]))
        assert np.array_equal(*bits), name


@pytest.fixture
def small_chunks(monkeypatch):
    """Several tasks also where all runs together take less than a second."""
    monkeypatch.setattr(_sweep, "_CHUNK_S", 0.0)


def test_the_table_is_that_of_the_command_line(command, small_chunks):
    said = command("sweep", SQUARE, *WORDS)
    assert said.returncode == 0, said.stderr
    equals(kontur.sweep(SQUARE, GRID), said.stdout)


def test_tables_are_equal_by_their_values():
    table = kontur.sweep(SQUARE, {"program[7].FREQ": [20, 30]})
    again = kontur.sweep(SQUARE, {"program[7].FREQ": [20, 30]})
    assert table == again
    assert table != kontur.sweep(SQUARE, {"program[7].FREQ": [20, 31]})
    assert table != "a table"
    run = kontur.run(SQUARE)
    assert run == kontur.run(SQUARE)
    assert run != table


def test_what_makes_no_difference_is_named(command, small_chunks):
    """The program sets its own frequency: the one of the list is not used."""
    keys = ["X.vib_guard.freq", "X,Y.getriebe[0].kv"]
    words = [f"--vary={key}={values}" for key, values in zip(keys, ["20,30", "2000,3000"])]
    said = command("sweep", SQUARE, *words)
    with pytest.warns(
        UserWarning, match="all values give the same results in these columns"
    ) as warned:
        table = kontur.sweep(SQUARE, dict(zip(keys, [[20, 30], [2000, 3000]])))
    assert [str(w.message) for w in warned] == [
        line.removeprefix("note: ") for line in said.stderr.splitlines() if "all values" in line
    ]
    assert list(table["without_effect"]) == ["X.vib_guard.freq"] * 4
    equals(table, said.stdout)


def test_columns_amplitudes_and_external_variables(command, program, small_chunks):
    part = program("N10 G01 X[V.E.Way] F3000\nN20 M30\n")
    wanted = ["--columns", "duration_s", "--amplitude", "X_acc_mm_s2@5..50"]
    said = command("sweep", part, "--vary", "V.E.Way=1,2,5000", *wanted, "--max-time", "9")
    table = kontur.sweep(
        part,
        {"V.E.Way": [1, 2, 5000]},
        columns=["duration_s", "X_acc_mm_s2@5..50"][:1],
        amplitude="X_acc_mm_s2@5..50",
        max_time=9,
    )
    equals(table, said.stdout)
    # the last one lies beyond the software limit: a row, not an exception
    assert list(table["state"]) == ["finished", "finished", "aborted"] and table["error"][2]


def test_a_data_set_by_what_varies(tmp_path):
    folder = tmp_path / "set"
    table = kontur.sweep(SQUARE, GRID, output=folder, columns=["duration_s"])
    found = pyarrow.dataset.dataset(folder, partitioning="hive").to_table()
    assert found.num_rows == len(table) == 9
    key = ("X,Y.getriebe[0].kv", "program[7].FREQ")
    of = {(float(row[key[0]]), float(row[key[1]])): row["duration_s"] for row in found.to_pylist()}
    for *keys, duration_s in zip(table[key[0]], table[key[1]], table["duration_s"]):
        assert of[tuple(keys)] == duration_s
    assert len([f for f in folder.rglob("*.parquet")]) == 9
    with pytest.raises(FileExistsError):
        kontur.sweep(SQUARE, GRID, output=folder)


def test_what_is_wrong_raises(tmp_path):
    for arguments in [
        {"grid": {}},
        {"grid": {"X.getriebe[0].kv": []}},
        {"grid": {"X.getriebe[0].kv": "3..1"}},
        {"grid": {"X.getriebe[0].kv": "1..100000000"}},
        {"grid": {"X.v": ["a,b"]}},
        {"grid": GRID, "columns": ["nonsense"]},
        {"grid": GRID, "amplitude": ["X"]},
        {"grid": GRID, "client": object()},
        {"grid": GRID, "frobnicate": 1},
    ]:
        with pytest.raises(kontur.UsageError):
            kontur.sweep(SQUARE, **arguments)
    with pytest.raises(kontur.ListsError) as caught:
        kontur.sweep(SQUARE, {"Q.getriebe[0].kv": [1, 2]})
    assert caught.value.diagnostics
    with pytest.raises(FileNotFoundError):
        kontur.sweep(tmp_path / "nowhere.nc", GRID)


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_ctrl_c_stops_a_sweep(program):
    part = program("N10 G01 X50 F0.5\nN20 M30\n")
    script = f"""
import kontur
print("go", flush=True)
try:
    kontur.sweep({str(part)!r}, {{"X.getriebe[0].kv": "1000..9000:1000"}})
except KeyboardInterrupt:
    print("stopped", len(kontur.sweep({str(SQUARE)!r}, {{"X.getriebe[0].kv": [2000, 3000]}})))
"""
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "go\n"
    time.sleep(1)
    process.send_signal(2)
    out, _ = process.communicate(timeout=60)
    assert out == "stopped 2\n" and process.returncode == 0


def test_a_dask_cluster_that_loses_a_worker(small_chunks, monkeypatch):
    distributed = pytest.importorskip("distributed")
    grid = {"X,Y.getriebe[0].kv": "1000..6000:50"}
    expected = kontur.sweep(SQUARE, grid)
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    )
    with cluster, distributed.Client(cluster) as client:
        pids = client.run(os.getpid)
        done = []
        engine = _sweep._dask

        def watched(words, chunks, *rest):
            for i, result in enumerate(engine(words, chunks, *rest)):
                done.append(i)
                if i == 10:
                    # in the middle of its work, and with results on it
                    os.kill(next(iter(pids.values())), 9)
                yield result

        monkeypatch.setattr(_sweep, "_dask", watched)
        table = kontur.sweep(SQUARE, grid, client=client)
        assert len(done) == 100
        assert set(client.run(os.getpid).values()) != set(pids.values()), "no worker was lost"
    same(table, expected)


def test_errors_come_from_the_cluster(program):
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(n_workers=1, processes=False, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client, pytest.raises(kontur.ListsError) as caught:
        kontur.sweep(SQUARE, {"X.getriebe[0].kv": [2000, "much"]}, client=client, retries=0)
    assert caught.value.diagnostics[0].is_error


def test_ray(small_chunks):
    ray = pytest.importorskip("ray")
    expected = kontur.sweep(SQUARE, GRID)
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        same(kontur.sweep(SQUARE, GRID, client=ray), expected)
    finally:
        ray.shutdown()


def test_shards_are_the_table(command, tmp_path):
    """Part by part, one of them killed and started again: as one run."""
    whole = command("sweep", SQUARE, *WORDS).stdout
    parts = []
    for i in (1, 2):
        file = tmp_path / f"part-{i}.csv"
        said = command("sweep", SQUARE, *WORDS, "--shard", f"{i}/2", "-o", file)
        assert said.returncode == 0, said.stderr
        parts.append(file.read_text())
    header = parts[0].splitlines()[0]
    assert all(part.startswith(header) for part in parts)
    joined = header + "\n" + "".join(part.split("\n", 1)[1] for part in parts)
    # what has no effect is the only thing that a part says of itself
    assert header.endswith(",without_effect")
    assert [row.rpartition(",")[0] for row in joined.splitlines()] == whole.splitlines()
    assert command("sweep", SQUARE, *WORDS, "--shard", "10/10").returncode == 2
    assert command("sweep", SQUARE, *WORDS, "--shard", "3/2").returncode == 2
    assert (
        command("sweep", SQUARE, *WORDS, "--shard", "1/2", "-o", tmp_path / "a.svg").returncode == 2
    )


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_a_killed_shard_goes_on(binary, command, tmp_path):
    words = ["sweep", str(SQUARE), "--vary", "X,Y.getriebe[0].kv=1000..6000:20", "--shard", "2/3"]
    expected = tmp_path / "expected.csv"
    command(*words, "-o", expected)
    file = tmp_path / "part.csv"
    journal = tmp_path / "part.csv.rows"
    process = subprocess.Popen([binary, *words, "-o", str(file)])
    # killed with some rows done and others not
    while process.poll() is None and not (
        journal.exists() and journal.read_bytes().count(b"\n") > 5
    ):
        time.sleep(0.001)
    process.kill()
    process.wait()
    kept = journal.read_bytes().count(b"\n") - 1
    assert 0 < kept < 84 and not file.exists()
    assert command(*words, "-o", file).returncode == 0
    assert file.read_text() == expected.read_text() and not journal.exists()
