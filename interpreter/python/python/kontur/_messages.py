"""Messages about programs, lists and inputs."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Diagnostic:
    """One message of ``kontur check --diagnostics json``; as a string, the same message as text."""

    id: str
    """``20008`` (the vendor's number) or ``K-0012`` (kontur's own); see :func:`kontur.explain`."""
    severity: str
    """``note``, ``warning`` or ``error``."""
    text: str
    """The message itself."""
    file: str | None
    """Program, list or input file; None if the message belongs to none."""
    line: int | None
    """Line of the file, from 1."""
    column: int | None
    """Column in characters, from 1."""
    hint: str | None
    """What to do about it."""
    details: dict[str, Any] = field(repr=False, hash=False)
    """All fields of the JSON form: axis, values, parameter, reaction, cycle, ..."""
    rendered: str = field(repr=False, compare=False)
    """The text form with the source line."""

    @classmethod
    def _of(cls, said: tuple[str, str]) -> Diagnostic:
        details = json.loads(said[0])
        source = details["source"] or {}
        vendor = details["id"]
        return cls(
            id=details["kontur_id"] if vendor is None else str(vendor),
            severity=details["severity"],
            text=details["text"],
            file=source.get("file"),
            line=source.get("line"),
            column=source.get("column"),
            hint=details["hint"],
            details=details,
            rendered=said[1],
        )

    @property
    def is_error(self) -> bool:
        """Whether the program or list was refused or aborted because of it."""
        return self.severity == "error"

    def __str__(self) -> str:
        return self.rendered.rstrip("\n")
