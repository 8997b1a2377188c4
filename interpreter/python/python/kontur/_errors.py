"""The exceptions, which carry the messages about a program, its lists and its inputs."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ._messages import Diagnostic
from ._result import Run

if TYPE_CHECKING:
    from typing_extensions import Self


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
