"""axe-core, where it is here: ``axe.min.js`` of npm's package of that name."""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).parents[2]
VIOLATIONS = """axe.run(document, {resultTypes: ["violations"]}).then(found => found.violations.map(v =>
  v.id + ": " + v.nodes.map(n => n.target.join(" ")).slice(0, 4).join("; ")))"""


def axe_core() -> str | None:
    """The source of axe-core, or None."""
    places = (os.environ.get("AXE_CORE", ""), ROOT / "node_modules" / "axe-core" / "axe.min.js")
    found = next((Path(place) for place in places if place and Path(place).is_file()), None)
    return None if found is None else found.read_text(encoding="utf-8")
