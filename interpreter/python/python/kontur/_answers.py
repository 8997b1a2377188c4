"""Requests that are answered at once."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _kontur
from ._messages import Diagnostic
from ._table import Table
from ._words import (
    Options,
    Settings,
    StrPath,
    program_words,
    settings_of,
    simulation_words,
    words_of,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

Numbers = float | str | Iterable[float]
"""``4``, ``[1, 2, 5]``, or as on the command line ``"2..200:2"``."""

Shaper = str | Mapping[str, Any] | Iterable[str | Mapping[str, Any]]
"""``"MODE=2,FREQ=40"``, ``{"MODE": 2, "FREQ": 40}``, or several of them."""


def check(
    program: StrPath,
    *,
    machine: StrPath | None = None,
    settings: Settings | None = None,
    **options: Unpack[Options],
) -> list[Diagnostic]:
    """Checks a program without moving anything and returns all diagnostics, errors included.

    Raises the same as :func:`run`, except for errors of the program itself.
    """
    words = program_words(program, machine, settings, options)
    return [Diagnostic._of(said) for said in _kontur.check(words)]


def explain(thing: str) -> str:
    """Explains an error ID (``22060``), a parameter (``P-AXIS-00571`` or its key) or a command (``#VIB GUARD``).

    Raises :class:`UsageError` for an unknown name, with similar names.
    """
    return _kontur.explain(thing)


def _shapers(shapers: Shaper | None) -> list[str]:
    if shapers is None:
        return []
    if isinstance(shapers, (str, Mapping)):
        shapers = [shapers]

    def one(shaper: str | Mapping[str, Any]) -> str:
        if isinstance(shaper, str):
            return shaper
        return ",".join(f"{key}={value}" for key, value in shaper.items())

    return [one(shaper) for shaper in shapers]


def response(
    *,
    filter: str | Iterable[str] | None = None,
    prototype: str | Iterable[str] | None = None,
    order: Numbers | None = None,
    f0: Numbers | None = None,
    q: Numbers | None = None,
    time: Numbers | None = None,
    share: Numbers | None = None,
    guard: Shaper | None = None,
    fir: str | Iterable[str] | None = None,
    hsc_mean: Numbers | None = None,
    hsc_novib: Numbers | None = None,
    axis: str | Iterable[str] | None = None,
    step: bool = False,
    residual: bool = False,
    corner: float | str | None = None,
    damping: Numbers | None = None,
    range: tuple[float, float] | None = None,
    machine: StrPath | None = None,
    settings: Settings | None = None,
    cycle_us: int | None = None,
) -> Table:
    """Frequency response of filters, shapers and the chains of axes; or step response, residual vibration, contour at a corner.

    The arguments are those of ``kontur response``, the columns those of its table; column ``curve`` names the curve of a
    row. The output of the command on stderr becomes warnings here.
    """
    given = dict(locals())
    del given["settings"], given["guard"]
    words = [*words_of(given), *words_of({"guard": _shapers(guard)}), *settings_of(settings)]
    columns, said = _kontur.response(words)
    _warn(said)
    return _table(columns)


class Tuning(Table):
    """One row per choice: ``mode``, ``freq_hz``, ``residual_ratio``, ``contour_err_mm``, ...; 0 for no and 1 for yes."""

    def __init__(self, columns: dict[str, Any], command: str | None, text: str) -> None:
        super().__init__(columns)
        self.command = command
        """The NC command to paste; None if no choice meets the requirements."""
        self.text = text
        """The output of ``kontur tune``."""

    def __str__(self) -> str:
        return self.text


def tune(
    *,
    freq: Numbers | None = None,
    recording: StrPath | Iterable[StrPath] | None = None,
    column: str | None = None,
    rate: float | None = None,
    range: tuple[float, float] | None = None,
    window: tuple[float, float] | None = None,
    damping: float | None = None,
    at: float | None = None,
    max_residual: float | None = None,
    feed: float | str | None = None,
    order_for: float | None = None,
    program: StrPath | None = None,
    max_dev: float | None = None,
    machine: StrPath | None = None,
    settings: Settings | None = None,
    **options: Unpack[Options],
) -> Tuning:
    """Vibration Guard settings from measured frequencies or recordings, or the order of a filter.

    The arguments are those of ``kontur tune``. With ``program`` and ``max_dev`` every choice is run, and the rows
    describe the runs; with ``order_for`` the rows are orders of filters.
    """
    own = dict(locals())
    del own["machine"], own["settings"], own["options"]
    words = [*words_of(own), *simulation_words(machine, settings, options)]
    columns, command, text, said = _kontur.tune(words)
    _warn(said)
    return Tuning(_arrays(columns), command, text)


def _arrays(columns: dict[str, Any]) -> dict[str, Any]:
    return {name: np.asarray(values) for name, values in columns.items()}


def _table(columns: dict[str, Any]) -> Table:
    return Table(_arrays(columns))


def _warn(lines: str) -> None:
    for line in lines.splitlines():
        warnings.warn(json.loads(line)["text"], stacklevel=3)
