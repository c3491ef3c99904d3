"""A folder of files, whole or not at all: it appears under its name when all of them stand, or never."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from ridgeback.common.errors import InputError


def write_folder(path: str, files: Mapping[str, str]) -> None:
    """Write files by their paths below a new folder.

    Raises InputError when something has that name already: nothing is replaced.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as place:
    ...     write_folder(f"{place}/clock/", {"src/clock.c": "int x;"})
    ...     (Path(place) / "clock" / "src" / "clock.c").read_text()
    'int x;'
    """
    target = Path(path).resolve()
    if target.exists():
        raise InputError(f"{path} exists already; name a new folder, nothing is replaced")
    made = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.parent))
    try:
        for name, text in files.items():
            place = made / name
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")
        made.chmod(0o755)
        made.rename(target)
    except BaseException:
        shutil.rmtree(made, ignore_errors=True)
        raise
