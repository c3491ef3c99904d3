"""What came of each mutant, kept in a file: one JSON object per line, the last of a mutant holds."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from tests.mutants.changes import Mutant


class Log:
    """The tests that killed mutants of files as they are now; kept nowhere without a file."""

    def __init__(self, root: Path, place: Path | None) -> None:
        self.root, self.place, self.known = root, place, dict[str, str]()
        if place is not None and place.exists():
            for line in place.read_text(encoding="utf-8").splitlines():
                entry = json.loads(line)
                self.known[entry["mutant"]] = entry["killer"]

    def name(self, mutant: Mutant) -> str:
        """A mutant by its place in its file's very text."""
        digest = hashlib.sha256((self.root / mutant.path).read_bytes()).hexdigest()[:16]
        return f"{mutant.path} {digest} {mutant.place}"

    def killer(self, mutant: Mutant) -> str | None:
        """The test that killed a mutant, empty for a survivor; None for one that was not tried."""
        return self.known.get(self.name(mutant))

    def note(self, mutant: Mutant, test: str) -> None:
        """Keep what came of a mutant."""
        self.known[self.name(mutant)] = test
        if self.place is not None:
            with self.place.open("a", encoding="utf-8") as file:
                print(json.dumps({"mutant": self.name(mutant), "killer": test}), file=file)
