"""Run the generated code of an expansion: the Python module as it is, and the C function where a compiler exists.

The text that is loaded here was written by ``symbolic.codegen`` from exact rationals a moment before; no user
text reaches it unprinted (names are identifiers, comments are escaped by the writers).
"""

from __future__ import annotations

import ctypes
import importlib.util
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.symbolic.codegen import generate
from ridgeback.symbolic.codegen.c99 import identifier
from ridgeback.symbolic.expansion.expansion import Expansion

Vectorised = Callable[[Array], Array]
COMPILERS = ("cc", "gcc", "clang")
_FLAGS = ("-O2", "-std=c99", "-shared", "-fPIC", "-ffp-contract=off")

# The generated function takes one number; this loop over an array is what a caller would write around it.
_LOOP = """
#include <stddef.h>
void over_array(const double *x, double *y, size_t n, double k);
void over_array(const double *x, double *y, size_t n, double k)
{{
    for (size_t i = 0; i < n; i++) y[i] = {name}_omega0(x[i], k);
}}
"""


@contextmanager
def python_module(expansion: Expansion) -> Iterator[ModuleType]:
    """Write the generated Python to a temporary file and import it from there, for the time of the block."""
    with tempfile.TemporaryDirectory(prefix="ridgeback-") as folder:
        path = Path(folder) / "generated.py"
        path.write_text(generate(expansion, "python"), encoding="utf-8")
        specification = importlib.util.spec_from_file_location("ridgeback_generated", path)
        if specification is None or specification.loader is None:
            raise InputError(f"{path} cannot be imported as a module")
        module = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(module)
        yield module


def compiler() -> str | None:
    """Path of a C compiler, or None."""
    return next((path for name in COMPILERS if (path := shutil.which(name))), None)


def compiled(expansion: Expansion, folder: Path) -> Vectorised | None:
    """Compile the generated C in ``folder`` and return its omega0 over arrays; None where it cannot be had.

    The shared library stays loaded for the life of the process.
    """
    program = compiler()
    if program is None:
        return None
    source, library = folder / "generated.c", folder / "generated.so"
    loop = _LOOP.format(name=identifier(expansion.system))
    source.write_text(generate(expansion, "c") + loop, encoding="utf-8")
    command = [program, *_FLAGS, str(source), "-o", str(library)]
    done = subprocess.run(command, capture_output=True, timeout=60, check=False)  # noqa: S603 - our own arguments
    return _loaded(library, float(expansion.scale)) if done.returncode == 0 else None


def _loaded(library: Path, k: float) -> Vectorised:
    fill = ctypes.CDLL(str(library)).over_array
    pointer = np.ctypeslib.ndpointer(dtype=np.float64, ndim=1, flags="C_CONTIGUOUS")
    fill.argtypes, fill.restype = [pointer, pointer, ctypes.c_size_t, ctypes.c_double], None

    def values(x: Array) -> Array:
        given = np.ascontiguousarray(x, dtype=np.float64)
        out = np.empty_like(given)
        fill(given, out, given.size, k)
        return out

    return values
