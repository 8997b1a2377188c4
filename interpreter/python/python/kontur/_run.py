"""Runs of programs."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _kontur
from ._errors import ProgramError, UsageError
from ._messages import Diagnostic
from ._result import Run
from ._table import Words
from ._words import Options, Settings, StrPath, program_words

if TYPE_CHECKING:
    from typing_extensions import Unpack

DEFAULT_SIGNALS = "default"
"""Groups of columns by default."""

MOST_LINES = 2**32 - 1
"""Lines of a program are counted in 32 bits."""

MOST_CYCLES = 2**64 - 1
"""Cycles are counted in 64 bits."""


class Simulation:
    """A running program.

    It is an iterator over its cycles, each a dict from column to value::

        for cycle in kontur.start("part.nc", signals="X_set_mm"):
            print(cycle["t_s"], cycle["X_set_mm"])

    and continues in sections with :meth:`run_until`, which returns their rows as columns.
    """

    def __init__(self, native: _kontur.Simulation) -> None:
        self._native = native
        self._units = dict(native.units())

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return self

    def __next__(self) -> dict[str, Any]:
        cycle = self._native.next_cycle()
        if cycle is not None:
            return cycle
        if self._native.is_aborted():
            raise _failed(self._result())
        raise StopIteration

    def run_until(self, *, line: int | None = None, time_s: float | None = None) -> Run:
        """Continues the run and returns the rows of this section; the summary is that of the whole run so far.

        ``line``: up to the first cycle in this line of the program (not of a subroutine), or the next time that the line is
        entered. ``time_s``: up to the first cycle that is not earlier. Without either, or if neither is reached: to the end.

        Raises :class:`ProgramError` if the program is refused or aborted, with the rows of this section as its ``run``.
        """
        if line is not None and not 1 <= line <= MOST_LINES:
            raise UsageError(f"line: a number from 1 to {MOST_LINES} is expected")
        if time_s is not None and not math.isfinite(time_s):
            raise UsageError("time_s: a time in s is expected")
        self._native.advance(line, time_s)
        result = self._result()
        if self._native.is_aborted():
            raise _failed(result)
        return result

    @property
    def is_over(self) -> bool:
        """There are no more cycles."""
        return self._native.is_over()

    @property
    def units(self) -> dict[str, str]:
        """Unit of every column."""
        return dict(self._units)

    @property
    def summary(self) -> dict[str, Any]:
        """The summary so far."""
        summary: dict[str, Any] = json.loads(self._native.summary()[0])
        return summary

    @property
    def messages(self) -> list[Diagnostic]:
        """All messages so far."""
        return [Diagnostic._of(said) for said in self._native.messages()]

    def _result(self) -> Run:
        columns = {name: _column(values) for name, values in self._native.take().items()}
        return Run(columns, self.units, self._native.summary(), self.messages)


def _column(values: Any) -> Any:
    if not isinstance(values, tuple):
        return values
    numbers, rest = values
    if isinstance(rest, list):
        return Words(numbers, rest)
    return np.ma.MaskedArray(numbers, rest, copy=False)


def _failed(result: Run) -> ProgramError:
    errors = [d for d in result.messages if d.is_error]
    moved = result.summary["cycles"] > 0
    what = "was aborted" if moved else "was refused before its first cycle"
    message = f"{result.summary['program']} {what}"
    return ProgramError(message, errors or result.messages, result)


def start(
    program: StrPath,
    *,
    machine: StrPath | None = None,
    settings: Settings | None = None,
    signals: str = DEFAULT_SIGNALS,
    decimate: int = 1,
    **options: Unpack[Options],
) -> Simulation:
    """Opens a program and stops before its first cycle. Arguments and errors are those of :func:`run`.

    A program that is refused by the check before the run raises :class:`ProgramError` at its first cycle.
    """
    words = program_words(program, machine, settings, options)
    if isinstance(decimate, int) and not 1 <= decimate <= MOST_CYCLES:
        raise UsageError("decimate: a whole number above 0 is expected")
    return Simulation(_kontur.Simulation(words, signals, decimate))


def run(
    program: StrPath,
    *,
    machine: StrPath | None = None,
    settings: Settings | None = None,
    signals: str = DEFAULT_SIGNALS,
    decimate: int = 1,
    **options: Unpack[Options],
) -> Run:
    """Runs a program to its end.

    ``machine``: folder with parameter lists, or the start-up list; without it the built-in ``xyz``.
    ``settings``: list parameters that replace those of the machine, ``{"X.getriebe[0].kv": 5000}``.
    ``signals``: groups or names of columns, separated by commas; ``default`` omits columns that only repeat others.
    ``decimate``: number of cycles per row.
    Others: see :class:`kontur._words.Options`.

    The interpreter lock is released while it computes; Ctrl-C ends it with ``KeyboardInterrupt``.

    Raises :class:`ProgramError` for a program that is refused or aborted, :class:`ListsError`, :class:`InputsError` and
    :class:`UsageError` for what it is run with, ``OSError`` for a file that cannot be read, and ``MemoryError`` for more
    than 2 GiB of columns (then choose ``signals``, ``decimate``, or continue in parts with :meth:`Simulation.run_until`).
    """
    simulation = start(
        program, machine=machine, settings=settings, signals=signals, decimate=decimate, **options
    )
    return simulation.run_until()
