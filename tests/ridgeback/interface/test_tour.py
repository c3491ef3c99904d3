"""The notebook runs top to bottom, and shows what it says that it shows."""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
NOTEBOOK = ROOT / "docs" / "tour.ipynb"
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
RUNNER = """
import ast, json, sys
import matplotlib
matplotlib.use("agg")
cells, names, shown = json.load(sys.stdin), {}, []
for cell in cells:
    tree = ast.parse(cell)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) and not cell.rstrip().endswith(";") else None
    exec(compile(tree, "tour.ipynb", "exec"), names)
    value = None if last is None else eval(compile(ast.Expression(last.value), "tour.ipynb", "eval"), names)
    shown.append(None if value is None else " ".join(repr(value).split()))
sys.stderr.write(json.dumps(shown))
"""


def cells() -> list[dict]:
    return [cell for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]


def kept(cell: dict) -> str | None:
    """The text of the value that is kept in the notebook, None where a cell shows none."""
    texts = [o["data"]["text/plain"] for o in cell["outputs"] if o["output_type"] == "execute_result"]
    return " ".join("".join(texts[0]).split()) if texts else None


@pytest.fixture(scope="module")
def shown() -> list[str | None]:
    """What each cell's last expression is, in a fresh interpreter that starts in the project's root."""
    told = json.dumps(["".join(cell["source"]) for cell in cells()])
    # What the libraries themselves call dated is not what this test is about.
    command = [sys.executable, "-W", "error", "-W", "ignore::DeprecationWarning", "-c", RUNNER]
    done = subprocess.run(command, cwd=ROOT, input=told, capture_output=True, text=True, timeout=900, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stderr)


def close(one: str, other: str) -> bool:
    """Whether two texts agree in their words exactly, and in their numbers to what another machine may round."""
    a, b = NUMBER.findall(one), NUMBER.findall(other)
    same = NUMBER.sub("#", one) == NUMBER.sub("#", other)
    return same and all(
        math.isclose(float(x), float(y), rel_tol=2e-2, abs_tol=1e-12) for x, y in zip(a, b, strict=True)
    )


def test_the_notebook_goes_through_every_verb() -> None:
    text = "\n".join("".join(cell["source"]) for cell in cells())
    assert all(
        f"ridgeback.{verb}(" in text
        for verb in ("derive", "generate", "simulate", "estimate", "backbone", "identify", "study", "report")
    )


def test_it_runs_and_what_it_keeps_is_what_it_gives(shown) -> None:
    for cell, value in zip(cells(), shown, strict=True):
        expected = kept(cell)
        if expected is not None:
            assert value is not None
            assert close(re.sub(r"\s", "", value), re.sub(r"\s", "", expected)), "".join(cell["source"])


def test_it_keeps_small_outputs_and_no_trace_of_a_machine() -> None:
    text = NOTEBOOK.read_text(encoding="utf-8")
    assert len(text) < 200_000
    assert "Traceback" not in text
    assert not re.search(r"/home/|/root/|/tmp/", text)
    assert all(cell["outputs"] or cell["source"][-1].endswith(";") or "import" in cell["source"][0] for cell in cells())
