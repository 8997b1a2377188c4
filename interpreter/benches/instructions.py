#!/usr/bin/env python3
"""Counts the instructions that a run takes per block, in all and by function.

    interpreter/benches/instructions.py [--case run] [--blocks 4000] [--rows 60] [--kontur PATH] [--inside]

Runs two spirals (see peers.py), one of twice as many blocks, under `callgrind` (Debian: valgrind) and prints the difference per block,
so that everything that happens once per run drops out. All threads count together. A function contains what it calls, with `--inside` it
does not. Counts repeat to within a percent; which functions are named depends on what the compiler made part of others. Fewer
instructions are not always less time: `callgrind` counts a long copy byte by byte and a miss of a cache not at all.

Measured is the release build without link-time optimisation, where more functions keep their names.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from peers import ROOT, write_programs

QUIET = ["--summary", "none"]
# words of the command line for each case, behind the program
CASES = {
    "check": None,
    "run": QUIET,
    "deviation": [*QUIET, "-o", "{}/trace.csv", "--signals", "contour_err_mm", "--decimate", "1000000000"],
    "csv": [*QUIET, "-o", "{}/trace.csv"],
    "parquet": [*QUIET, "-o", "{}/trace.parquet"],
    "summary": ["--summary", "text"],
}


def counted(kontur, program, case, folder, inside):
    """Instructions in all and by function, of one run."""
    more = CASES[case]
    words = ["check", program] if more is None else ["run", program, "--max-time", "1e6", *more]
    words = [str(word).format(folder) for word in words]
    out = folder / "callgrind.out"
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", kontur, *words]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{done.stderr[-2000:]}")
    options = [f"--inclusive={'no' if inside else 'yes'}", "--threshold=100", "--auto=no"]
    table = subprocess.run(["callgrind_annotate", *options, out], check=True, capture_output=True, text=True).stdout
    functions = {}
    for line in table.splitlines():
        if row := re.match(r"\s*([\d,]+) \(\s*[\d.]+%\)\s+(.*)", line):
            count, name = int(row[1].replace(",", "")), row[2]
            name = "in all" if name == "PROGRAM TOTALS" else re.sub(r"^[^:]*:|\[[^\[]*\]$|::h[0-9a-f]{16}", "", name).strip()
            functions[name] = functions.get(name, 0) + count
    return functions


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--case", choices=CASES, default="run")
    arguments.add_argument("--blocks", type=int, default=4000, help="of the shorter program")
    arguments.add_argument("--rows", type=int, default=60)
    arguments.add_argument("--kontur", type=Path, help="a binary [default: the release is built]")
    arguments.add_argument("--inside", action="store_true", help="without what a function calls")
    asked = arguments.parse_args()
    kontur = asked.kontur
    if kontur is None:
        environment = {**os.environ, "CARGO_PROFILE_RELEASE_LTO": "off"}
        subprocess.run(["cargo", "build", "--release", "-p", "kontur"], cwd=ROOT, check=True, env=environment)
        kontur = ROOT / "target/release/kontur"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        few, many = (
            counted(kontur.resolve(), write_programs(folder, count)[0], asked.case, folder, asked.inside)
            for count in (asked.blocks, 2 * asked.blocks)
        )
    rows = sorted(((many[name] - few.get(name, 0)) / asked.blocks, name) for name in many)
    print(f"{asked.case}, {asked.blocks} and {2 * asked.blocks} blocks: instructions per block\n")
    for count, name in rows[: -asked.rows - 1 : -1]:
        print(f"{count:10,.0f}  {name}")


if __name__ == "__main__":
    main()
