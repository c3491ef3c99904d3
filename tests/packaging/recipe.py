"""The conda recipe, gone through step by step without a channel.

An environment holds what ``requirements`` asks for and nothing else, by the names of the Python index; then the build
script, the imports and the commands of the recipe's test run as they stand.  What this cannot show is that a channel
has the libraries in these versions.
"""

from __future__ import annotations

import re
import shlex
import sys
from collections.abc import Mapping
from pathlib import Path

import jinja2

from tests.packaging.processes import ROOT, run

INDEX = {"matplotlib-base": "matplotlib"}
"""Libraries that the index has under another name."""
Parts = Mapping[str, list[str]]


def rendered(python: Path) -> str:
    """The recipe with its variables put in; paths from the recipe's own folder."""
    text = (ROOT / "recipe" / "meta.yaml").read_text(encoding="utf-8")
    return jinja2.Template(text, undefined=jinja2.StrictUndefined).render(PYTHON=python)


def parts(text: str) -> Parts:
    """The lists of a recipe by section and key, such as ``requirements/run``; a single value is a list of one."""
    found: dict[str, list[str]] = {}
    section = key = ""
    for line in text.splitlines():
        if top := re.match(r"(\w+):$", line):
            section = top[1]
        elif entry := re.match(r"  (\w+):\s*(.*)$", line):
            key = f"{section}/{entry[1]}"
            found[key] = [entry[2]] if entry[2] else []
        elif item := re.match(r"    - (.*)$", line):
            found[key].append(item[1])
    return found


def libraries(lines: list[str]) -> list[str]:
    """What the index calls the libraries; Python itself is the environment's."""
    names = (line.partition(" ") for line in lines if not line.startswith("python "))
    return [f"{INDEX.get(name, name)}{floor}" for name, _, floor in names]


def followed(folder: Path) -> int:
    """Build and test as the recipe says, in an environment of its own; the number of its steps."""
    python = folder / "recipe" / "bin" / "python"
    run(sys.executable, "-m", "venv", folder / "recipe", cwd=folder)
    steps = parts(rendered(python))
    run(python, "-m", "pip", "install", "--quiet", *libraries(steps["requirements/host"] + steps["requirements/run"]),
        cwd=folder)  # fmt: skip
    (script,) = steps["build/script"]
    commands = [
        script,
        *(f"{python} -c 'import {name}'" for name in steps["test/imports"]),
        *steps["test/commands"],
    ]
    for command in commands:
        run("env", f"PATH={python.parent}:/usr/bin:/bin", *shlex.split(command), cwd=ROOT)
    return len(commands)
