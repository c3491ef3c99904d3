"""The generated C of a formula, compiled and loaded where this machine can; what cannot be had is said, not raised.

The text that is loaded here was written by ``symbolic.codegen`` from exact numbers a moment before, under names of our
own.
"""

from __future__ import annotations

import ctypes
import re
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.generated_code import OWN, omega0_of
from ridgeback.compare.binding.programs import finished
from ridgeback.numeric.arrays import Array
from ridgeback.symbolic.codegen.fit.fit import Fit
from ridgeback.symbolic.codegen.languages.c import language as c
from ridgeback.symbolic.codegen.program import Form
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.resummation.resummation import Resummation

Vectorised = Callable[[Array], Array]
OfAmplitude: TypeAlias = "Expansion | Resummation | Fit"
"""A formula of one variable, whose code has a function omega0."""
COMPILERS = ("cc", "gcc", "clang")
PATIENCE = 20.0
"""Seconds that a compiler may take for a page of C."""
_FLAGS = ("-O3", "-std=c99", "-shared", "-fPIC", "-ffp-contract=off")


@dataclass(frozen=True)
class NotCompiled:
    """Why there is no compiled function: a part of a sentence."""

    reason: str


def compiler() -> str | None:
    """Path of a C compiler, or None."""
    return next((path for name in COMPILERS if (path := shutil.which(name))), None)


@contextmanager
def compiled(formula: OfAmplitude) -> Iterator[Vectorised | NotCompiled]:
    """The omega0 of the generated C over arrays, or why it cannot be had; nothing that goes wrong here is raised.

    It is compiled in a temporary folder that is removed after the block; the library stays loaded until the process
    ends.
    """
    try:
        form = omega0_of(formula)
    except InputError as refusal:
        yield NotCompiled(str(refusal))
        return
    with compiled_together((form,)) as (native,):
        yield native


@contextmanager
def compiled_together(forms: Sequence[Form]) -> Iterator[tuple[Vectorised | NotCompiled, ...]]:
    """The same of several forms of omega0 in one library, which takes half the time of one for each."""
    named = [replace(form, name=f"{OWN}_{i}") for i, form in enumerate(forms)]
    with ExitStack() as stack:
        found = _compiled(named, stack) if named else ()
        yield (found,) * len(named) if isinstance(found, NotCompiled) else found


def _compiled(forms: Sequence[Form], stack: ExitStack) -> tuple[Vectorised, ...] | NotCompiled:
    program = compiler()
    if program is None:
        return NotCompiled("there is no C compiler")
    source = "\n".join(_apart(form.name, c.untested(form)) for form in forms)
    try:
        folder = Path(stack.enter_context(TemporaryDirectory(prefix="ridgeback-", ignore_cleanup_errors=True)))
        file, library = folder / f"{OWN}.c", folder / f"{OWN}.so"
        file.write_text(source, encoding="utf-8")
        patience = PATIENCE * len(forms)
        done = finished([program, *_FLAGS, str(file), "-o", str(library), "-lm"], patience)
        if done is None:
            return NotCompiled(f"the C compiler did not finish within {patience:g} s")
        if done.code != 0:
            return NotCompiled("the C compiler failed")
        return tuple(_loaded(library, form) for form in forms)
    except (OSError, AttributeError, ValueError) as error:
        return NotCompiled(f"the temporary folder does not serve for compiled code ({' '.join(str(error).split())})")


_STATIC = re.compile(r"^static [^(=;{\n]*?\b([A-Za-z_]\w*)\s*[\[(=]", flags=re.MULTILINE)


def _apart(name: str, text: str) -> str:
    r"""A source whose static names are its own, so that several stand in one file.

    >>> _apart("a", "static const double points[2] = {0, 1};")
    '#define points a_points\nstatic const double points[2] = {0, 1};\n#undef points\n'
    """
    own = sorted(set(_STATIC.findall(text)))
    return "\n".join((*(f"#define {n} {name}_{n}" for n in own), text, *(f"#undef {n}" for n in own), ""))


def _loaded(library: Path, form: Form) -> Vectorised:
    (omega0,), name = form.functions, form.name
    k = omega0.arguments[-1].default
    fill = getattr(ctypes.CDLL(str(library)), f"{name}_omega0_array")
    pointer = np.ctypeslib.ndpointer(dtype=np.float64, ndim=1, flags="C_CONTIGUOUS")
    fill.argtypes, fill.restype = [pointer, pointer, ctypes.c_size_t, ctypes.c_double], None

    def values(x: Array) -> Array:
        given = np.ascontiguousarray(x, dtype=np.float64)
        out = np.empty_like(given)
        fill(given, out, given.size, k)
        return out

    return values
