#!/usr/bin/env python3
"""Times kontur beside its peers on this machine and prints the table of their ratios.

    interpreter/benches/peers.py [--blocks 200000] [--repeats 3] [--kontur PATH]

Every round runs every case once, so that a machine that slows down slows all of them; medians are printed, with the least and the
greatest of the rounds. CPU time counts, wall time is shown beside it. Peak memory is never below that of this script, from
which the processes are started. Peers, each left out by name where it is not installed:

* `rs274` of LinuxCNC (Debian: linuxcnc-uspace) reads the same blocks and only interprets them: the yardstick, 1.
* `pyarrow` writes the columns of the same trace as Parquet, `polars` as CSV (pip install pyarrow polars). They do not compute the
  deviation from the contour, which a run needs only for its trace: what kontur writes is compared on top of a run that
  computes the deviation and shows one cycle of it.

The third-order profiles have their own bench beside `rsruckig`: cargo bench -p kontur-motion --bench third_order
"""

import argparse
import importlib.util
import math
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def blocks(count):
    """A spiral that rises: short blocks of three axes without a sharp corner, some 0.3 mm long."""
    for i in range(count):
        angle = i * 0.3 / 40.0
        radius = 40.0 + 5.0 * math.sin(i * 0.001)
        yield f"N{10 * (i % 900000) + 10} X{radius * math.cos(angle):.3f} Y{radius * math.sin(angle):.3f} Z{i * 0.0001:.3f}\n"


def write_programs(folder, count):
    """The same blocks for kontur, with the guard, and for an interpreter that does not know it."""
    body = "".join(blocks(count))
    ours, plain = folder / f"{count}.nc", folder / f"{count}.ngc"
    ours.write_text("#VIB GUARD ON [MODE=2 FREQ=40]\n#SLOPE [TYPE=HSC]\nG01 F6000\n" + body + "M30\n")
    plain.write_text("G21 G90 G64\nG01 F6000\n" + body + "M2\n")
    return ours, plain


def timed(words):
    """CPU and wall seconds and the peak memory in MiB of a process."""
    begin = time.perf_counter()
    with open(os.devnull, "w") as nothing:
        process = subprocess.Popen([str(w) for w in words], stdout=nothing, stderr=subprocess.PIPE)
        said = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(map(str, words))} failed:\n{said.decode()[-2000:]}")
    wall = time.perf_counter() - begin
    return used.ru_utime + used.ru_stime, wall, used.ru_maxrss / 1024


def peer(library, parquet, folder):
    """CPU and wall seconds that a library needs to write the columns of a trace. In a separate process: what it has loaded would
    count as memory of every process that is started from here."""
    words = [sys.executable, __file__, "--write-with", library, parquet, folder]
    answer = subprocess.run([str(w) for w in words], check=True, capture_output=True, text=True)
    cpu, wall = map(float, answer.stdout.split())
    return cpu, wall, float("nan")


def write_with(library, parquet, folder):
    """The process of `peer`."""
    if library == "pyarrow":
        import pyarrow.parquet as pq

        table = pq.read_table(parquet)
        floats = [f.name for f in table.schema if str(f.type) == "double"]
        options = {
            "compression": "snappy",
            "use_dictionary": [n for n in table.column_names if n not in floats],
            "column_encoding": {name: "BYTE_STREAM_SPLIT" for name in floats},
        }
        work = lambda: pq.write_table(table, Path(folder) / "peer.parquet", **options)
    else:
        import polars

        frame = polars.read_parquet(parquet)
        work = lambda: frame.write_csv(Path(folder) / "peer.csv", float_precision=7)
    before, begin = resource.getrusage(resource.RUSAGE_SELF), time.perf_counter()
    work()
    after, wall = resource.getrusage(resource.RUSAGE_SELF), time.perf_counter() - begin
    print(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall)


def has(module):
    return importlib.util.find_spec(module) is not None


def cases(folder, kontur, count, absent):
    """Name and work of each case, in the order of a round."""
    ours, plain = write_programs(folder, count)
    few, _ = write_programs(folder, max(count // 10, 1))
    csv, parquet = folder / "trace.csv", folder / "trace.parquet"
    quiet = ["--summary", "none", "--max-time", "1e6"]

    def run(program, *more):
        return lambda: timed([kontur, "run", program, *quiet, *more])

    found = {}
    if shutil.which("rs274"):
        found["rs274 -g, interprets only"] = lambda: timed(["rs274", "-g", plain, folder / "canon.txt"])
    else:
        absent.append("rs274")
    found["kontur check"] = lambda: timed([kontur, "check", ours])
    found["kontur run, no trace"] = run(ours)
    found["kontur run, deviation"] = run(ours, "-o", csv, "--signals", "contour_err_mm", "--decimate", 10**9)
    found["kontur run, CSV"] = run(ours, "-o", csv)
    found["kontur run, Parquet"] = run(ours, "-o", parquet)
    found["kontur run, a tenth of the blocks"] = run(few)
    subprocess.run([kontur, "run", ours, *quiet, "-o", parquet], check=True)
    for library, what in [("pyarrow", "the same Parquet"), ("polars", "the same CSV")]:
        if has(library):
            found[f"{library}, {what}"] = lambda library=library: peer(library, parquet, folder)
        else:
            absent.append(library)
    return found


def spread(values, unit=1.0):
    return f"{statistics.median(values) * unit:.2f} ({min(values) * unit:.2f} to {max(values) * unit:.2f})"


def ratios(measured, count):
    """What the table is for: each ratio, of medians of CPU time."""
    cpu = {name: statistics.median(m[0] for m in rounds) for name, rounds in measured.items()}
    run, few = cpu["kontur run, no trace"], cpu["kontur run, a tenth of the blocks"]
    measured_run = cpu["kontur run, deviation"]
    if yardstick := cpu.get("rs274 -g, interprets only"):
        for name, goal in [("check", 0.10), ("run, no trace", 0.5), ("run, CSV", 1.0)]:
            yield f"{name} / rs274", cpu[f"kontur {name}"] / yardstick, goal
    if peer := cpu.get("pyarrow, the same Parquet"):
        yield "Parquet on top of a run with the deviation / pyarrow", (cpu["kontur run, Parquet"] - measured_run) / peer, 1.1
        yield "Parquet on top of a run / pyarrow", (cpu["kontur run, Parquet"] - run) / peer, None
    if peer := cpu.get("polars, the same CSV"):
        yield "CSV on top of a run with the deviation / polars", (cpu["kontur run, CSV"] - measured_run) / peer, None
    yield "per block, ten times the blocks", run / (count * few / max(count // 10, 1)), 1.05


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--blocks", type=int, default=200_000)
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--kontur", type=Path, help="a binary [default: the release is built]")
    arguments.add_argument("--write-with", nargs=3, help=argparse.SUPPRESS)
    asked = arguments.parse_args()
    if asked.write_with:
        write_with(*asked.write_with)
        return
    kontur = asked.kontur
    if kontur is None:
        subprocess.run(["cargo", "build", "--release", "-p", "kontur"], cwd=ROOT, check=True)
        kontur = ROOT / "target/release/kontur"
    absent = []
    with tempfile.TemporaryDirectory() as name:
        found = cases(Path(name), kontur.resolve(), asked.blocks, absent)
        measured = {case: [] for case in found}
        for _ in range(asked.repeats):
            for case, work in found.items():
                measured[case].append(work())
    print(f"{asked.blocks} blocks, {asked.repeats} rounds; medians, least and greatest in brackets\n")
    print("| case | CPU in s | wall in s | peak memory in MiB, at most |\n|---|---|---|---|")
    for case, rounds in measured.items():
        cpu, wall, memory = zip(*rounds)
        peak = "" if math.isnan(memory[0]) else f"{max(memory):.0f}"
        print(f"| {case} | {spread(cpu)} | {spread(wall)} | {peak} |")
    print("\n| ratio of CPU time | measured | goal |\n|---|---|---|")
    for what, ratio, goal in ratios(measured, asked.blocks):
        print(f"| {what} | {ratio:.2f} | {'' if goal is None else goal} |")
    if absent:
        print(f"\nNot on this machine: {', '.join(absent)}")


if __name__ == "__main__":
    main()
