"""Options of Python as words of the command line, which reads, checks and refuses them in one place."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from decimal import Decimal
from numbers import Real
from pathlib import Path
from typing import Any, TypedDict, Union

from ._errors import UsageError

StrPath = Union[str, "os.PathLike[str]"]
Settings = Mapping[str, Any] | Iterable[str]


class Options(TypedDict, total=False):
    """Options of the simulation; those of ``kontur run`` with the same names."""

    path: StrPath | Iterable[StrPath]
    """Folders with global subroutines."""
    allow_outside: bool
    """Subroutines may lie outside the program's folder and ``path``."""
    input: StrPath | Iterable[StrPath]
    """Files of real-time inputs."""
    cycle_us: int
    """Cycle time in microseconds, instead of that of the machine."""
    start: Mapping[str, float]
    """Start positions in mm (deg) by axis name."""
    skip: Iterable[int]
    """Active skip levels, 1 to 10."""
    max_time: float
    """Program time in s after which a program is stopped, default one day."""
    max_blocks: int
    """Number of blocks after which a program is stopped, default 1e8."""
    strict: bool
    """Refuse list keys that are not modelled."""
    identity_trafo: bool
    """Treat kinematic transformations as identity, with a warning."""
    techno_times: bool
    """Wait for M, H, S and T functions for the times declared in the channel list."""
    external: Mapping[str, float | str]
    """Values of external variables by their names after ``V.E.``."""


_SIMULATION = frozenset(Options.__annotations__)
"""Names of the options of a simulation."""

_SPANS = frozenset({"range", "window"})
"""Options whose two numbers are the ends of a range."""


def text_of(value: Any) -> str:
    """A value as written in a list or on the command line: all digits of a number, and no exponent, as numbers have none there."""
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Real):
        text = repr(float(value))
        return format(Decimal(text), "f") if math.isfinite(value) else text
    raise TypeError(f"{value!r}: a number or a text is expected")


def words_of(options: Mapping[str, Any]) -> list[str]:
    """Options as words. None and False omit an option."""
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif name in _SPANS and isinstance(value, (tuple, list)):
            low, high = value
            words.append(f"{option}={text_of(low)}..{text_of(high)}")
        elif isinstance(value, Mapping):
            words += [f"{option}={key}={text_of(of)}" for key, of in value.items()]
        elif isinstance(value, (str, os.PathLike)) or not isinstance(value, Iterable):
            words.append(f"{option}={text_of(value)}")
        else:
            several = list(value)
            if all(isinstance(one, Real) for one in several):
                # one list of numbers, not several options
                several = [",".join(map(text_of, several))] if several else []
            words += [f"{option}={text_of(one)}" for one in several]
    return words


def settings_of(settings: Settings | None) -> list[str]:
    """List parameters as words."""
    if settings is None:
        return []
    if isinstance(settings, str):
        raise TypeError("settings: a dict or a list of KEY=VALUE is expected")
    if isinstance(settings, Mapping):
        return words_of({"set": settings})
    return [f"--set={one}" for one in settings]


def simulation_words(
    machine: StrPath | None, settings: Settings | None, options: Mapping[str, Any]
) -> list[str]:
    """Machine, settings and options of a simulation."""
    for name in options:
        if name not in _SIMULATION:
            known = ", ".join(sorted(_SIMULATION))
            raise UsageError(f"no option `{name}`; the options are {known}")
    return [*words_of({"machine": machine}), *settings_of(settings), *words_of(options)]


def program_words(
    program: StrPath,
    machine: StrPath | None,
    settings: Settings | None,
    options: Mapping[str, Any],
) -> list[str]:
    """All words for one program; it is taken as a file, whatever its name looks like."""
    name = os.fspath(program)
    if name == "-":
        name = str(Path(".")) + os.sep + "-"
    return [*simulation_words(machine, settings, options), "--", name]
