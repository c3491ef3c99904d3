"""What Ridgeback finds around it: its libraries, optional parts, compilers, browsers, and what each would add.

Versions come from the installed packages' metadata and programs from the search path: nothing is imported or run.
"""

from __future__ import annotations

import platform
import re
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, entry_points, requires, version
from typing import Any, Final

from ridgeback.console.browser import NAMES as BROWSERS

NEEDED: Final[Mapping[str, str]] = {
    "click": "the command line",
    "jinja2": "the page of the report",
    "latex2mathml": "formulas on the page",
    "matplotlib": "figures",
    "mpmath": "integration at any precision",
    "numpy": "arrays",
    "python-flint": "exact rationals and balls",
    "scipy": "integration, splines, filters",
    "sympy": "equations and formulas",
}
EXTRAS: Final[Mapping[str, tuple[str, str]]] = {
    "h5py": ("hdf5", "HDF5 files and MATLAB's v7.3"),
    "openpyxl": ("excel", "workbooks (.xlsx)"),
    "pandas": ("tables", "to_dataframe()"),
    "xarray": ("tables", "to_xarray()"),
    "heyoka": ("heyoka", "simulate --method heyoka"),
    "distributed": ("distributed", "study --scheduler: workers on many machines"),
    "pyarrow": ("studies", "study --format parquet"),
    "h5netcdf": ("studies", "study --format netcdf"),
    "zarr": ("studies", "study --format zarr"),
}
PROGRAMS: Final[Mapping[str, tuple[tuple[str, ...], str]]] = {
    "C": (("cc", "gcc", "clang"), "generate --language c --check; timed C in benchmarks"),
    "C++": (("c++", "g++", "clang++"), "generate --language cpp --check"),
    "Fortran": (("gfortran",), "generate --language fortran --check"),
    "Rust": (("rustc",), "generate --language rust --check"),
    "Julia": (("julia",), "generate --language julia --check"),
    "Octave": (("octave-cli", "octave"), "generate --language matlab --check"),
    "Node": (("node", "nodejs"), "generate --language javascript --check"),
    "Gappa": (("gappa",), "a second proof of the rounding, by the script of generate --gappa"),
    "browser": (BROWSERS, "report --pdf"),
}
GROUPS: Final = ("ridgeback.systems", "ridgeback.estimators", "ridgeback.languages", "ridgeback.sections")


@dataclass(frozen=True)
class Part:
    """One thing that Ridgeback needs or can use."""

    kind: str
    """"needed", "optional", "program" or "plugin"."""
    name: str
    found: str | None
    """Version or path; None where it is not there."""
    adds: str
    """What it is for."""
    remedy: str | None = None
    """How to get it, where it is missing or too old."""

    @property
    def wrong(self) -> bool:
        """Whether Ridgeback cannot work like this."""
        return self.kind == "needed" and self.remedy is not None


def parts() -> tuple[Part, ...]:
    """Everything, in the order in which it is told."""
    return (*_needed(), *_extras(), *_programs(), *_plugins())


def about() -> dict[str, Any]:
    """Ridgeback, Python and the system, and all parts, as plain data."""
    return {
        "schema": "doctor/1",
        "ridgeback": installed("ridgeback"),
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        "parts": [asdict(part) for part in parts()],
    }


def installed(name: str) -> str | None:
    """The version of an installed distribution.

    >>> installed("no-such-distribution") is None
    True
    """
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _needed() -> Iterator[Part]:
    least = lowest()
    for name, adds in NEEDED.items():
        found, floor = installed(name), least.get(name)
        old = found is not None and floor is not None and numbers(found) < numbers(floor)
        remedy = f"pip install '{name}>={floor}'" if old or found is None else None
        yield Part("needed", name, found, adds, remedy)


def _extras() -> Iterator[Part]:
    for name, (extra, adds) in EXTRAS.items():
        found = installed(name)
        yield Part("optional", name, found, adds, None if found else f"pip install 'ridgeback[{extra}]'")


def _programs() -> Iterator[Part]:
    for name, (commands, adds) in PROGRAMS.items():
        found = next((path for path in map(shutil.which, commands) if path), None)
        yield Part("program", name, found, adds, None if found else f"any of {', '.join(commands)} on the path")


def _plugins() -> Iterator[Part]:
    for group in GROUPS:
        for point in entry_points(group=group):
            owner = f"{point.dist.name} {point.dist.version}" if point.dist else point.value
            yield Part("plugin", point.name, owner, f"entry point of {group}")


def lowest() -> dict[str, str]:
    """The lowest version of each needed library, as Ridgeback's own metadata has it."""
    try:
        stated = [text for text in requires("ridgeback") or () if "extra ==" not in text]
    except PackageNotFoundError:
        return {}
    return {found[1].lower(): found[2] for text in stated if (found := re.match(r"([\w.-]+)\s*>=\s*([\d.]+)", text))}


def numbers(text: str) -> tuple[int, ...]:
    """The leading numbers of a version, to be compared.

    >>> numbers("2.10.0rc1") > numbers("2.9")
    True
    """
    return tuple(int(word) for word in re.findall(r"\d+", re.split(r"[a-z+]", text)[0]))
