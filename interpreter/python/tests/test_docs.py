"""Every script of the documents runs."""

import itertools
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

README = ROOT / "interpreter" / "python" / "README.md"
BATCH = ROOT / "interpreter" / "cli" / "docs" / "batch.md"
EDITOR = ROOT / "interpreter" / "book" / "pages" / "editor.md"


def blocks(path: Path, language: str) -> list[str]:
    return re.findall(
        rf"^```{language}\n(.*?)^```", path.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )


@pytest.mark.parametrize(
    "script", [*blocks(README, "python"), *blocks(ROOT / "README.md", "python")]
)
def test_scripts_run(script, tmp_path):
    if "distributed" in script:
        pytest.importorskip("distributed")
    script = script.replace('"target/kv"', repr(str(tmp_path / "set")))
    file = tmp_path / "script.py"
    file.write_text(script, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, file], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.skipif(os.name == "nt", reason="a shell script")
def test_the_job_array_gives_the_whole_table(binary, command, tmp_path):
    job, join = blocks(BATCH, "sh")
    (tmp_path / "programs").symlink_to(ROOT / "programs")
    tools = tmp_path / "bin"
    tools.mkdir()
    (tools / "kontur").symlink_to(Path(binary).resolve())
    path = f"{tools}:{os.environ['PATH']}"
    for number in (3, 1, 4, 2):
        variables = {**os.environ, "PATH": path, "SLURM_ARRAY_TASK_ID": str(number)}
        subprocess.run(["bash", "-c", job], cwd=tmp_path, env=variables, check=True)
    subprocess.run(["bash", "-c", join], cwd=tmp_path, check=True)
    varied = re.findall(r"--vary '([^']*)'", job)
    words = [word for key in varied for word in ("--vary", key)]
    whole = command("sweep", ROOT / "programs" / "square_corner.nc", *words)
    header, *rows = (tmp_path / "table.csv").read_text().splitlines()
    # the column that each part fills for itself
    assert header.endswith(",without_effect")
    assert [row.rpartition(",")[0] for row in [header, *rows]] == whole.stdout.splitlines()


def test_the_problem_matcher_of_the_book_finds_every_place(command, program):
    """The patterns that an editor is given match the messages of the command line, place by place."""
    (task,) = blocks(EDITOR, "json")
    first, second = json.loads(task)["tasks"][0]["problemMatcher"]["pattern"]
    text = "".join(f"N{n} G01 X1 F1000\n" for n in range(1, 120))
    path = program(f"G777\n#CONTOUR [\n#SLOPE (TYPE=HSC)\n{text}G01 X[\nFOO=1\n", "my part.nc")
    found = json.loads(command("check", path, "--format", "json").stdout)["diagnostics"]
    lines = command("check", path).stderr.splitlines()
    matched = []
    for line, place in itertools.pairwise(lines):
        if message := re.match(first["regexp"], line):
            at = re.match(second["regexp"], place)
            assert at, place
            severity, code = message[first["severity"]], message[first["code"]]
            where = (at[second["file"]], int(at[second["line"]]), int(at[second["column"]]))
            matched.append((severity, code, message[first["message"]], *where))
    expected = [
        (
            d["severity"],
            str(d["id"] or d["kontur_id"]),
            d["text"],
            d["source"]["file"],
            d["source"]["line"],
            d["source"]["column"],
        )
        for d in found
    ]
    assert matched == expected
    assert len(matched) > 4
    assert {"error", "warning"} <= {d[0] for d in matched}
    assert max(d[4] for d in matched) > 99
