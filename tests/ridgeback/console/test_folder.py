"""A folder of generated files is written whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from ridgeback.common.errors import InputError
from ridgeback.console.folder import write_folder


def test_a_package_is_written_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_folder(f"{tmp_path}/clock/", {"src/a.c": "x", "b.txt": "y"})
    assert (tmp_path / "clock" / "src" / "a.c").read_text() == "x"
    with pytest.raises(InputError, match="exists already"):
        write_folder(f"{tmp_path}/clock/", {"a": "z"})

    def fails(self: Path, *_: object, **__: object) -> int:
        raise OSError(28, "No space left on device", str(self))

    monkeypatch.setattr(Path, "write_text", fails)
    with pytest.raises(OSError, match="No space"):
        write_folder(f"{tmp_path}/second/", {"a": "z"})
    assert sorted(p.name for p in tmp_path.iterdir()) == ["clock"]
