"""Change the code of a process that runs: functions take their changed code, modules and classes their changed values.

The tests are collected once, with everything imported, and every mutant is tried in a copy of that process.
"""

from __future__ import annotations

import gc
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from tests.mutants.changes import Mutant, changed

PLAIN = (int, float, complex, str, bytes, tuple, frozenset, list, dict, set, np.ndarray, np.generic, type(None))


def patched(root: Path, mutant: Mutant) -> bool:
    """Carry a mutant out in this process; False where nothing that is kept shows it.

    Raises whatever a changed module raises when it is read.
    """
    file = root / mutant.path
    whole = file.read_text(encoding="utf-8")
    old, new = compile(whole, str(file), "exec"), compile(changed(whole, mutant.place), str(file), "exec")
    triples = list(zip(codes(old), codes(compile(changed(whole, -1), str(file), "exec")), codes(new), strict=True))
    deep = [(code, after) for code, before, after in triples if shape(before) != shape(after)]
    count = sum(take(code, after, file) for code, after in deep if code.co_flags & inspect.CO_OPTIMIZED)
    if not count or any(
        not code.co_flags & inspect.CO_OPTIMIZED and shape(b, 0) != shape(a, 0) for code, b, a in triples
    ):
        count += sum(revalue(module, new) for module in modules_of(file))
    return count > 0


def codes(code: CodeType) -> Iterator[CodeType]:
    """A code and all codes in it, in the order of the text."""
    yield code
    for part in code.co_consts:
        if isinstance(part, CodeType):
            yield from codes(part)


def shape(code: CodeType, depth: int = 99) -> tuple[Any, ...]:
    """What a code does, without its lines; ``depth`` 0 leaves out the codes in it."""
    parts = [
        (shape(p, depth - 1) if depth else "code") if isinstance(p, CodeType) else (type(p), repr(p))
        for p in code.co_consts
    ]
    return code.co_code, code.co_names, code.co_varnames, tuple(parts)


def take(code: CodeType, after: CodeType, file: Path) -> int:
    """Give every function that has a code another one; how many there are."""
    here = [f for f in gc.get_objects() if type(f) is FunctionType and f.__code__.co_qualname == code.co_qualname]
    here = [f for f in here if f.__code__.co_firstlineno == code.co_firstlineno and same_file(f.__code__, file)]
    for function in here:
        function.__code__ = after
    return len(here)


def same_file(code: CodeType, file: Path) -> bool:
    return code.co_filename.endswith(file.name) and Path(code.co_filename).resolve() == file.resolve()


def modules_of(file: Path) -> list[ModuleType]:
    """The modules read from a file."""
    named = [m for m in list(sys.modules.values()) if (getattr(m, "__file__", None) or "").endswith(file.name)]
    return [m for m in named if Path(str(m.__file__)).resolve() == file.resolve()]


def revalue(module: ModuleType, code: CodeType) -> int:
    """Run a changed module aside, and take over every plain value and default that it gives otherwise."""
    fresh = {name: value for name, value in vars(module).items() if name.startswith("__")}
    exec(code, fresh)  # noqa: S102 - our own module with one place changed
    count = 0
    for name, value in fresh.items():
        was = vars(module).get(name)
        if isinstance(was, PLAIN) and isinstance(value, PLAIN) and not name.startswith("__"):
            count += repr(was) != repr(value) and everywhere(name, was, value)
        elif isinstance(was, type) and isinstance(value, type) and was.__module__ == module.__name__:
            count += retyped(was, value)
        else:
            count += redefaulted(was, value)
    return count


def everywhere(name: str, was: object, value: object) -> int:
    """Rebind a name in every module that holds the value under it."""
    holders = [m for m in list(sys.modules.values()) if m is not None and vars(m).get(name) is was]
    for module in holders:
        setattr(module, name, value)
    return len(holders)


def retyped(was: type, value: type) -> int:
    """Take over the plain values of a class and the defaults of its methods."""
    count = 0
    for name, new in vars(value).items():
        old = vars(was).get(name)
        if name == "__init__" or not name.startswith("__"):
            if isinstance(old, PLAIN) and isinstance(new, PLAIN):
                if repr(old) != repr(new):
                    setattr(was, name, new)
                    count += 1
            else:
                count += redefaulted(getattr(old, "__func__", old), getattr(new, "__func__", new))
    return count


def redefaulted(was: object, value: object) -> int:
    """Take over the defaults of a function."""
    was, value = inspect.unwrap(was), inspect.unwrap(value)  # type: ignore[arg-type]
    if type(was) is not FunctionType or type(value) is not FunctionType:
        return 0
    given = repr((was.__defaults__, was.__kwdefaults__)) != repr((value.__defaults__, value.__kwdefaults__))
    if given:
        was.__defaults__, was.__kwdefaults__ = value.__defaults__, value.__kwdefaults__
    return int(given)
