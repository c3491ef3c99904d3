"""Run every command of the ``sh`` blocks of README and docs/, whatever time they take; for a release.

    python -m tests.pages [--seconds 600] [PAGE...]

The commands of a page run in their order in one folder, which holds recordings and a description under the names that
the pages use for the reader's own files.  Told are those that fail, those that ran out of time, and those whose file is
the reader's own and is not here.  Only lines that call Ridgeback are run.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from tests.pages.requests import two_columns

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^```sh\n(.*?)^```", flags=re.DOTALL | re.MULTILINE)
GIVEN = (
    *(("sample", "decay", "-o", name) for name in ("sloshing-decay.csv", "logger.csv", "release.csv")),
    ("simulate", "damped-pendulum", "--initial", "2.5,0", "--duration", "160", "--rate", "8", "-o", "run.csv"),
    *(
        ("simulate", "damped-pendulum", "--initial", f"{a},0", "--duration", "160", "--rate", "8", "-o", f"run{i}.csv")
        for i, a in ((1, 2.4), (2, 2.2), (3, 2.0))
    ),
)
MINE = """[oscillator]
equation = "x'' + 2*mu*x' + x + x**3/3 - x**5/40 = 0"
initial = [1.2, 0]
[oscillator.parameters]
mu = "1/50"
"""


def commands(page: Path) -> Iterator[str]:
    """The lines of the ``sh`` blocks that call Ridgeback."""
    for block in BLOCK.findall(page.read_text(encoding="utf-8")):
        yield from (line for line in block.splitlines() if line.startswith("ridgeback "))


def prepared(folder: Path) -> None:
    """The reader's own files under the names of the pages."""
    for arguments in GIVEN:
        subprocess.run([sys.executable, "-m", "ridgeback", *arguments], cwd=folder, check=True)
    for run in folder.glob("run*.csv"):
        two_columns(run)
    decay = (folder / "sloshing-decay.csv").read_text(encoding="utf-8")
    (folder / "decay.csv").write_text(decay.replace("displacement [mm]", "displacement"), encoding="utf-8")
    (folder / "mine.toml").write_text(MINE, encoding="utf-8")


def outcome(line: str, folder: Path, seconds: float) -> str:
    """What came of a line: "" where it ended well."""
    words = shlex.split(line, comments=True)
    absent = [
        word for word in words if re.fullmatch(r"[\w-]+\.(csv|h5|wav|mat|db)", word) and not (folder / word).exists()
    ]
    try:
        done = subprocess.run(
            ["bash", "-c", line],
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=seconds,
            check=False,
            env={**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"},
        )
    except subprocess.TimeoutExpired:
        return f"not done after {seconds:g} s"
    if done.returncode in (0, 3):  # 3: the output is whole, and says what it could not certify
        return ""
    return "the reader's own file" if absent else f"exit code {done.returncode}: {done.stderr.strip()[-300:]}"


def main() -> int:
    """Run and tell; 1 where a command fails."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--seconds", type=float, default=600.0, help="for one command")
    options.add_argument("pages", nargs="*", type=Path, metavar="PAGE")
    given = options.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory(prefix="ridgeback-pages-") as name:
        given_files = Path(name) / "given"
        given_files.mkdir()
        prepared(given_files)
        for page in given.pages or PAGES:
            folder = Path(name) / page.stem
            shutil.copytree(given_files, folder)
            for line in commands(page):
                begin = time.monotonic()
                said = outcome(line, folder, given.seconds)
                failed += said.startswith("exit code")
                print(f"{page.name}: {time.monotonic() - begin:6.1f} s  {said or 'done'}: {line}", flush=True)
            shutil.rmtree(folder)
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
