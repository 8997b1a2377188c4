"""The result of a program."""

from __future__ import annotations

import json
from typing import Any

from ._messages import Diagnostic
from ._table import Table


class Run(Table):
    """The result of a program: a row per cycle, row ``k`` at the time of ``k`` cycles.

    The columns are those of the trace of ``kontur run``. ``block`` is masked where a block has no number; the memory of
    the other columns is that of the simulation, not a copy.
    """

    def __init__(
        self,
        columns: dict[str, Any],
        units: dict[str, str],
        summary: tuple[str, str],
        messages: list[Diagnostic],
    ) -> None:
        super().__init__(columns)
        self.units = units
        """Unit of every column: ``mm``, ``deg/s``, ``Nm``; empty for words and counts."""
        self.summary: dict[str, Any] = json.loads(summary[0])
        """The output of ``kontur run --summary json``."""
        self.messages = messages
        """All messages, up to the first thousand."""
        self._text = summary[1]

    def __str__(self) -> str:
        return self._text.rstrip("\n")
