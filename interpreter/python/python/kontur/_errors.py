"""Messages about programs, lists and inputs, and the exceptions that carry them."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import Self

    from ._run import Run


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


class Error(Exception):
    """Base class of everything that kontur refuses. ``diagnostics`` gives the reasons as a list of :class:`Diagnostic`."""

    diagnostics: list[Diagnostic]

    def __init__(self, message: str, diagnostics: Iterable[Diagnostic] = ()) -> None:
        super().__init__(message)
        self.message = message
        self.diagnostics = list(diagnostics)

    @classmethod
    def of(cls, message: str, said: list[tuple[str, str]]) -> Self:
        """From the messages of the library."""
        return cls(message, map(Diagnostic._of, said))

    @classmethod
    def of_lines(cls, message: str, lines: str) -> Self:
        """From the JSON output of a command, one object per line."""
        said = [(line, json.loads(line)["text"]) for line in lines.splitlines()]
        return cls.of(message, [s for s in said if "kontur_id" in json.loads(s[0])])

    def __str__(self) -> str:
        errors = [str(d) for d in self.diagnostics if d.is_error]
        return "\n".join([self.message, *errors])

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self.message, self.diagnostics))


class UsageError(Error, ValueError):
    """An option or a value is wrong: exit code 2 of the command line."""


class ListsError(Error, ValueError):
    """The lists of the machine, or a setting, were refused: exit code 2."""


class InputsError(Error, ValueError):
    """A file of real-time inputs was refused: exit code 2."""


class ProgramError(Error):
    """The program was refused before its first cycle, or aborted: exit code 1.

    ``run`` holds what it did up to there (no rows if it was refused).
    """

    def __init__(
        self, message: str, diagnostics: Iterable[Diagnostic] = (), run: Run | None = None
    ) -> None:
        super().__init__(message, diagnostics)
        self.run = run

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self.message, self.diagnostics, self.run))
