"""What came of each mutant, kept in a file: one JSON object per line, the last of a mutant holds."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from tests.mutants.changes import Mutant


class Log:
    """The tests that killed mutants, with the digest of the files that they were of; kept nowhere without a file."""

    def __init__(self, root: Path, place: Path | None) -> None:
        self.root, self.place, self.known = root, place, dict[str, tuple[str, str]]()
        if place is not None and place.exists():
            for line in place.read_text(encoding="utf-8").splitlines():
                entry = json.loads(line)
                self.known[entry["mutant"]] = entry["file"], entry["killer"]

    def digest(self, mutant: Mutant) -> str:
        """Of the very text of its file."""
        return hashlib.sha256((self.root / mutant.path).read_bytes()).hexdigest()[:16]

    def killer(self, mutant: Mutant) -> str | None:
        """The test that killed a mutant, empty for a survivor; None for one not tried in its file as it is now."""
        file, test = self.known.get(mutant.name, ("", ""))
        return test if file == self.digest(mutant) else None

    def last(self, mutant: Mutant) -> str | None:
        """The same, whatever has become of its file since."""
        return self.known[mutant.name][1] if mutant.name in self.known else None

    def note(self, mutant: Mutant, test: str) -> None:
        """Keep what came of a mutant."""
        self.known[mutant.name] = self.digest(mutant), test
        if self.place is not None:
            with self.place.open("a", encoding="utf-8") as file:
                print(json.dumps({"mutant": mutant.name, "file": self.digest(mutant), "killer": test}), file=file)
