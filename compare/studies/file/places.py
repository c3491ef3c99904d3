"""Where in a study a value stands, for messages."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.file.lines import line_of


@dataclass(frozen=True)
class Source:
    """The text of a study, for messages that name a place in it."""

    name: str
    text: str
    overridden: frozenset[str] = frozenset()

    @contextmanager
    def at(self, path: str) -> Iterator[None]:
        """Give an InputError of the block the place of a key."""
        try:
            yield
        except LocatedError:
            raise
        except InputError as error:
            raise LocatedError(f"{self.place(path)}: {error}") from None

    def place(self, path: str) -> str:
        """File, line and key, or the option that set it."""
        if any(path == key or path.startswith(f"{key}.") for key in self.overridden):
            return f"--set {path}"
        line = line_of(self.text, path)
        return f"{self.name}, {f'line {line}, ' if line else ''}{path}" if path else self.name


class LocatedError(InputError):
    """An InputError that names its place already."""
