"""The studies that ship with the package, as commented TOML files.

Each runs as it stands and is meant to be changed; ``ridgeback study --example NAME`` prints one.
"""

from __future__ import annotations

from importlib.resources import files

from ridgeback.common.errors import InputError

NAMES = ("paper", "five-oscillators", "noise", "crossing", "estimators")


def example(name: str) -> str:
    """The text of a shipped study.

    >>> example("five-oscillators").splitlines()[0]
    '# Five oscillators: how far each order of the expansion errs, which order a tolerance needs, and whether the error'
    """
    if name not in NAMES:
        raise InputError(f"no example {name[:60]!r}; there are {', '.join(NAMES)}")
    return files(__name__).joinpath(f"{name.replace('-', '_')}.toml").read_text(encoding="utf-8")
