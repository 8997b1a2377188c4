"""Every script of the documents runs."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

README = ROOT / "interpreter" / "python" / "README.md"
BATCH = ROOT / "interpreter" / "cli" / "docs" / "batch.md"


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
    assert (tmp_path / "table.csv").read_text() == whole.stdout
