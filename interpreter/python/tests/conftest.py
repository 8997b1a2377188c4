"""Programs, and the command line to compare with."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PROGRAMS = ROOT / "programs"
SQUARE = PROGRAMS / "square_corner.nc"


@pytest.fixture(scope="session")
def binary() -> str:
    """The command line: ``KONTUR``, or built here."""
    if given := os.environ.get("KONTUR"):
        return given
    subprocess.run(["cargo", "build", "--release", "-p", "kontur"], cwd=ROOT, check=True)
    return str(ROOT / "target" / "release" / "kontur")


@pytest.fixture
def command(binary: str) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Calls the command line."""

    def call(*words: object) -> subprocess.CompletedProcess[str]:
        line = [binary, *map(str, words)]
        return subprocess.run(line, check=False, capture_output=True, text=True, encoding="utf-8")

    return call


@pytest.fixture
def program(tmp_path: Path) -> Callable[..., Path]:
    """Writes a program."""

    def write(text: str, name: str = "part.nc") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write
