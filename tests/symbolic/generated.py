"""Generated code, run: loaded as a module, or compiled and called."""

from __future__ import annotations

import ctypes
import importlib.util
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

COMPILER = shutil.which("cc") or shutil.which("gcc")
needs_compiler = pytest.mark.skipif(COMPILER is None, reason="no C compiler (cc or gcc) on this machine")
FLAGS = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wmissing-prototypes", "-ffp-contract=off"]


def load(source: str, folder: Path, name: str = "generated") -> ModuleType:
    path = folder / f"{name}.py"
    path.write_text(source, encoding="utf-8")
    specification = importlib.util.spec_from_file_location(name, path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def compiled(source: str, folder: Path, name: str, arguments: int) -> Callable[..., float]:
    (folder / "generated.c").write_text(source, encoding="utf-8")
    library = folder / f"{name}.so"  # a loader keeps what it once read under a path
    command = [
        COMPILER or "cc",
        *FLAGS,
        "-O2",
        "-shared",
        "-fPIC",
        "-o",
        str(library),
        str(folder / "generated.c"),
        "-lm",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    compiled_function = getattr(ctypes.CDLL(str(library)), name)
    compiled_function.restype = ctypes.c_double
    compiled_function.argtypes = [ctypes.c_double] * arguments
    return compiled_function  # type: ignore[no-any-return]
