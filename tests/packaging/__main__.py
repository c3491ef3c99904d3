"""Build the source archive and from it the wheel, look into both, and use the wheel beside names that could collide.

    python -m tests.packaging [PYTHON...]        (needs the package ``build``)

The archive holds plain files and builds without links; the wheel holds the one top-level package ``ridgeback``.
Installed beside the registry's package ``symbolic``, in a folder with a user's ``compare.py`` and ``reports/``, every
verb works.  The wheel is installed in an environment of its own by each PYTHON named, by this one where none is.  At
the end the steps of the conda recipe are gone through, with the index's packages under the recipe's names.
"""

from __future__ import annotations

import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.packaging import recipe
from tests.packaging.processes import ROOT, run

ROOMS = ("symbolic", "numeric", "compare", "reports")
VERBS: Sequence[tuple[str, ...]] = (
    ("systems",),
    ("derive", "pendulum", "--order", "4"),
    ("generate", "pendulum", "--order", "4"),
    ("simulate", "damped-pendulum", "--duration", "120", "--rate", "8", "-o", "run.csv"),
    ("estimate", "run.csv", "--column", "u", "--method", "hilbert", "--plot", "run.svg"),
    ("identify", "run.csv", "--column", "u", "--candidates", "linear,pendulum", "--damping", "linear"),
    ("study", "pendulum", "--orders", "2,4", "--amplitudes", "0.5,1"),
    ("report", "pendulum", "--trials", "0", "-o", "report.html"),
)
THEIRS = {
    "compare.py": "MINE = 1\n",
    "numeric.py": "MINE = 1\n",
    "reports/__init__.py": "",
    "reports/mine.py": "M = 1\n",
}


def modules() -> set[str]:
    """The files of the package as the tree has them, links followed."""
    rooms = {f"ridgeback/{p.relative_to(ROOT)}" for room in ROOMS for p in (ROOT / room).rglob("*") if is_ours(p)}
    face = {str(p.relative_to(ROOT)) for p in (ROOT / "ridgeback").rglob("*") if is_ours(p) and not through_link(p)}
    return rooms | face


def is_ours(path: Path) -> bool:
    """Whether a path is a file that belongs into the package."""
    return path.is_file() and "__pycache__" not in path.parts


def through_link(path: Path) -> bool:
    """Whether a path leads through a link, a room seen under its second name."""
    return any(above.is_symlink() for above in path.parents)


def wrong_in_archive(path: Path) -> Iterator[str]:
    """What is wrong with the source archive."""
    with tarfile.open(path) as archive:
        entries = archive.getmembers()
    names = {entry.name.partition("/")[2] for entry in entries}
    yield from (f"{entry.name} is a link" for entry in entries if entry.issym() or entry.islnk())
    yield from (f"{name} is not in the source archive" for name in sorted(modules() - names))
    for needed in ("README.md", "LICENSE", "CHANGELOG.md", "CONTRIBUTING.md", "pyproject.toml", "tests/conftest.py"):
        if needed not in names:
            yield f"{needed} is not in the source archive"


def wrong_in_wheel(path: Path) -> Iterator[str]:
    """What is wrong with the wheel."""
    with zipfile.ZipFile(path) as wheel:
        names = set(wheel.namelist())
    tops = {name.partition("/")[0] for name in names}
    yield from (f"{top} is at the top of the wheel" for top in tops if top != "ridgeback" and ".dist-info" not in top)
    yield from (f"{name} is not in the wheel" for name in sorted(modules() - names))
    yield from (f"{name} is in the wheel" for name in sorted(names - modules()) if ".dist-info/" not in name)


def used_beside_others(wheel: Path, folder: Path, interpreter: str) -> str:
    """Install the wheel beside ``symbolic`` and run every verb where a user's files have the rooms' names."""
    folder.mkdir()
    run(interpreter, "-m", "venv", folder / "venv", cwd=folder)
    python = folder / "venv" / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", wheel, "symbolic", cwd=folder)
    work = folder / "work"
    for name, text in THEIRS.items():
        (work / name).parent.mkdir(parents=True, exist_ok=True)
        (work / name).write_text(text, encoding="utf-8")
    for verb in VERBS:
        run(python, "-m", "ridgeback", *verb, cwd=work)  # the working folder comes first on Python's path
        run(folder / "venv" / "bin" / "ridgeback", *verb, cwd=work)
    run(python, "-c", "import symbolic, compare, reports.mine, ridgeback; assert compare.MINE", cwd=work)
    return run(python, "--version", cwd=work).strip()


def main(interpreters: Sequence[str]) -> int:
    """Build, look, use."""
    with tempfile.TemporaryDirectory(prefix="ridgeback-package-") as name:
        folder = Path(name)
        run(sys.executable, "-m", "build", "--outdir", folder / "dist", ROOT, cwd=folder)  # the wheel from the archive
        (archive,), (wheel,) = (folder / "dist").glob("*.tar.gz"), (folder / "dist").glob("*.whl")
        wrong = [*wrong_in_archive(archive), *wrong_in_wheel(wheel)]
        print(f"{archive.name}: {archive.stat().st_size} bytes; {wheel.name}: {wheel.stat().st_size} bytes")
        if wrong:
            print(*wrong, sep="\n", file=sys.stderr)
            return 1
        for count, interpreter in enumerate(interpreters):
            version = used_beside_others(wheel, folder / str(count), interpreter)
            print(f"{version}: {len(VERBS)} verbs, by name and by module, beside names that could collide: all done")
        print(f"conda recipe: {recipe.followed(folder)} steps done")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or [sys.executable]))
