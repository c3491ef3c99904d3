"""How to get the same result again: versions, parameters, the command and hashes of settings and input."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping
from importlib import metadata

from ridgeback.compare.report.results import Provenance

PACKAGES = ("ridgeback", "sympy", "python-flint", "mpmath", "numpy", "scipy", "matplotlib")


def versions() -> dict[str, str]:
    """Versions of Python and of what the numbers depend on; ``absent`` where a package is not installed.

    >>> sorted(versions())[:3]
    ['matplotlib', 'mpmath', 'numpy']
    """
    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            found[package] = "absent"
    return found


def settings_hash(settings: Mapping[str, object]) -> str:
    """First 16 hexadecimal digits of the SHA-256 of the settings as canonical JSON.

    >>> settings_hash({"b": 1, "a": 2}) == settings_hash({"a": 2, "b": 1})
    True
    """
    canonical = json.dumps(settings, sort_keys=True, separators=(",", ":"), default=str)
    return hashlib.sha256(canonical.encode()).hexdigest()[:16]


def provenance(
    settings: Mapping[str, object],
    *,
    command: str,
    input_hash: str = "",
    seconds: Mapping[str, float] | None = None,
) -> Provenance:
    """Provenance of one run; ``seconds`` (what took how long) is the only part that changes between runs."""
    return Provenance(
        command=command,
        versions=versions(),
        parameters={name: str(value) for name, value in settings.items()},
        settings_hash=settings_hash(settings),
        input_hash=input_hash,
        seconds=dict(seconds or {}),
    )
