"""A Python module: floats, lists and NumPy arrays alike; it imports NumPy only when an array comes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import ClassVar

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.in_place import changed_in_place, single_steps
from ridgeback.symbolic.codegen.languages.language import Language, table_name
from ridgeback.symbolic.codegen.lowering import operations
from ridgeback.symbolic.codegen.number import Number
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Operation, Step

ARRAYS = '''\
def _filled(function, lowest, highest, where, given, out=None):
    """A function of arrays, in blocks that stay in the processor's cache; not a number outside the domain."""
    import numpy

    given = [numpy.asarray(value, dtype=numpy.float64) for value in given]
    shapes = {value.shape for value in given} - {()}
    shape = shapes.pop() if len(shapes) == 1 else numpy.broadcast_shapes(*shapes)
    if out is None:
        out = numpy.empty(shape)
    elif out.shape != shape or out.dtype != numpy.float64:
        raise ValueError(f"out has shape {out.shape} and type {out.dtype}; give float64 of shape {shape}")
    flat = out if out.ndim == 1 else out.reshape(-1)
    if not numpy.shares_memory(flat, out):
        raise ValueError("out is not contiguous; give an array in one piece")
    rows = [v if v.ndim == 0 else (v if v.shape == shape else numpy.broadcast_to(v, shape)).reshape(-1) for v in given]
    with numpy.errstate(all="ignore"):
        for start in range(0, flat.size, BLOCK):
            block = [value if value.ndim == 0 else value[start : start + BLOCK] for value in rows]
            at = block[where]
            all_inside = lowest <= numpy.minimum.reduce(at) and numpy.maximum.reduce(at) <= highest
            outside = None if all_inside else ~((at >= lowest) & (at <= highest))
            flat[start : start + BLOCK] = function(*(float(v) if v.ndim == 0 else v for v in block))
            if not all_inside:
                flat[start : start + BLOCK][outside] = math.nan
    return out'''

EMULATED = '''\
def _fma(a, b, c):
    """a*b + c in one rounding (S. Boldo and G. Melquiond, IEEE Trans. Computers 57, 2008: rounding to odd)."""
    if isinstance(a, float) and isinstance(b, float) and isinstance(c, float):
        if hasattr(math, "fma"):
            return math.fma(a, b, c)
        exact = Fraction(a) * Fraction(b) + Fraction(c) if math.isfinite(a * b + c) else 0
        return float(exact) if exact else a * b + c
    import numpy

    a, b, c = numpy.broadcast_arrays(*(numpy.asarray(v, dtype=numpy.float64) for v in (a, b, c)))
    uh, ul = _two_product(a, b)
    th, tl = _two_sum(c, ul)
    vh, vl = _two_sum(uh, th)
    z, rest = _two_sum(tl, vl)
    bits = numpy.ascontiguousarray(z).view(numpy.int64)
    even = (rest != 0) & (bits & 1 == 0)
    z = numpy.where(even, (bits + numpy.where((rest > 0) == (z > 0), 1, -1)).view(numpy.float64), z)
    return vh + z


def _two_sum(a, b):
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def _two_product(a, b):
    p = a * b
    ah = 134217729.0 * a
    ah = ah - (ah - a)
    bh = 134217729.0 * b
    bh = bh - (bh - b)
    al, bl = a - ah, b - bh
    return p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)'''

SELF_TEST = '''\
def self_test():
    """Number of entries of the self-test tables that do not come out bit for bit."""
    failed = 0
    for function, points in _POINTS:
        for *given, expected in points:
            value = function(*given)
            array = function([given[0]], *given[1:])[0]
            failed += not all(v == expected or (v != v and expected != expected) for v in (value, array))
    return failed'''


class Python(Language):
    """A Python module."""

    name, suffix = "python", "py"
    comment, end = "#", ""
    tool = ("python3", "python")
    in_place: ClassVar[bool] = True
    """Whether values are changed in place."""

    def literal(self, value: float, form: Form) -> str:  # noqa: ARG002
        if math.isfinite(value):
            return repr(value)
        return "math.nan" if math.isnan(value) else "math.inf" if value > 0 else "-math.inf"

    def fused(self, a: str, b: str, c: str, form: Form) -> str:  # noqa: ARG002
        return f"_fma({a}, {b}, {c})"

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"_sqrt({a})"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"_floor({a})"

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:  # noqa: ARG002
        return f"{name} = {value}"

    def body(self, function: Function, form: Form) -> Iterator[str]:
        """In place where nothing reads the old value: an array is not copied at every step."""
        if not self.in_place:
            yield from super().body(function, form)
            return
        steps = single_steps(function, form)
        for step, old in zip(steps, changed_in_place(function, steps), strict=True):
            if isinstance(step, Horner):
                yield from self.loop(step, table_name(function, step), first=True, form=form)
                continue
            line = self.changed(step, old, form) if old else self.made(step, form)
            yield from self.noted(line, [o for o in step.operands if isinstance(o, Number)])

    def made(self, step: Step, form: Form) -> str:
        """A step whose result is new; a number is added to a product in its place."""
        if step.operation is Operation.MULTIPLY_ADD and not form.fused and isinstance(step.operands[2], Number):
            product = replace(step, operation=Operation.MULTIPLY, operands=step.operands[:2])
            total = replace(step, operation=Operation.ADD, operands=(step.name, step.operands[2]))
            return f"{step.name} = {self.expression(product, form)}; {self.changed(total, step.name, form)}"
        return f"{step.name} = {self.expression(step, form)}"

    def changed(self, step: Step, old: str, form: Form) -> str:
        """A step whose result takes the place of one operand."""
        fused = step.operation is Operation.MULTIPLY_ADD and form.fused
        if fused or (step.operation is Operation.SUBTRACT and step.operands[0] != old):
            return f"{step.name} = {self.expression(step, form)}"
        lines, others = [], [o for o in step.operands if o != old]
        if step.operation is Operation.MULTIPLY_ADD and step.operands[2] == old:
            lines.append(f"{old} += {self.operand(others[0], form)}*{self.second(others[1], form)}")
        else:
            signs = {Operation.MULTIPLY: "*", Operation.SUBTRACT: "-", Operation.ADD: "+", Operation.MULTIPLY_ADD: "*+"}
            for sign, other in zip(signs[step.operation], others, strict=True):
                text = self.operand(other, form)
                minus = sign == "+" and text.startswith("-")
                lines.append(f"{old} {'-' if minus else sign}= {text.removeprefix('-') if minus else text}")
        return "; ".join([*lines, *([f"{step.name} = {old}"] if step.name != old else [])])

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:  # noqa: ARG002
        name, at = horner.name, horner.at
        if form.fused:
            return [f"{name} = {table}[0]", f"for c in {table}[1:]:", f"    {name} = _fma({name}, {at}, c)"]
        return [
            f"{name} = {at}*{table}[0]",
            f"{name} += {table}[1]",
            f"for c in {table}[2:]:",
            f"    {name} *= {at}",
            f"    {name} += c",
        ]

    def write(self, form: Form) -> str:
        names = ", ".join(f'"{f.name}{tail}"' for f in form.functions for tail in ("", "_array", "_unchecked"))
        public = f'__all__ = [{names}, "self_test"]'
        parts = [f"{self._head(form)}\n\n{public}", *self._functions(form), self._points(form), SELF_TEST]
        return "\n\n\n".join(parts) + "\n"

    def untested(self, form: Form) -> str:
        """The source without its self-test."""
        return "\n\n\n".join([self._head(form), *self._functions(form)]) + "\n"

    def _head(self, form: Form) -> str:
        return "\n".join(['"""' + self.heading(form)[0], *self.heading(form)[1:], '"""', "", *self.imports(form)])

    def _functions(self, form: Form) -> list[str]:
        return [
            *(part for f in form.functions for part in self._function(f, form)),
            *self._helpers(form),
            *(self._table(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
        ]

    def imports(self, form: Form) -> list[str]:
        """What the module needs when it is loaded."""
        return ["import math", *(["from fractions import Fraction"] if form.fused else [])]

    def _helpers(self, form: Form) -> list[str]:
        steps = [step.operation.value for f in form.functions for step in operations(f, form)]
        parts = ["BLOCK = 4096", ARRAYS, *([EMULATED] if form.fused else [])]
        for word in ("sqrt", "floor"):
            if word in steps:
                parts.append(
                    f"def _{word}(x):\n    if isinstance(x, float):\n        return float(math.{word}(x))"
                    f"{' if x >= 0 else math.nan' if word == 'sqrt' else ''}\n"
                    f"    import numpy\n\n    return numpy.{word}(x)"
                )
        return parts

    def signature(self, function: Function) -> str:
        """The arguments with their defaults."""
        return ", ".join(a.name if a.default is None else f"{a.name}={a.default!r}" for a in function.arguments)

    def _function(self, function: Function, form: Form) -> list[str]:
        names = ", ".join(a.name for a in function.arguments)
        signature, first = self.signature(function), function.arguments[0].name
        others = signature.partition(", ")[2]
        domain = function.domain
        low, high = self.literal(domain.low, form), self.literal(domain.high, form)
        where = [a.name for a in function.arguments].index(domain.argument)
        scalar = " and ".join(f"isinstance({a.name}, (float, int))" for a in function.arguments)
        listed = f"({names},)" if len(function.arguments) == 1 else f"({names})"
        arrays = f"{function.name}_unchecked, {low}, {high}, {where}, {listed}"
        document = "\n    ".join(
            [
                f'"""{self.about(function)[0]}',
                "",
                *self.about(function)[1:],
                "",
                "Numbers, or arrays and lists of them; what lies outside the domain gives nan.",
                '"""',
            ]
        )
        convert = "; ".join(f"{a.name} = float({a.name})" for a in function.arguments)
        checked = (
            f"def {function.name}({signature}):\n    {document}\n"
            f"    if {scalar}:\n        {convert}\n"
            f"        return {function.name}_unchecked({names}) if {low} <= {domain.argument} <= {high} else math.nan\n"
            f"    return _filled({arrays})[()]"
        )
        array = (
            f"def {function.name}_array({first}, out{', ' + others if others else ''}):\n"
            f'    """The same into ``out``, a contiguous array of floats, which may be ``{first}`` itself."""\n'
            f"    return _filled({arrays}, out)"
        )
        body = "\n    ".join([*self.body(function, form), f"return {self.result(function, form)}"])
        plain = (
            f"def {function.name}_unchecked({signature}):\n"
            f'    """The same by floating-point arithmetic alone, wherever the arguments lie."""\n    {body}'
        )
        return [checked, array, plain]

    def result(self, function: Function, form: Form) -> str:
        """What is returned; a constant takes the shape of the argument in ``_filled``."""
        return self.operand(function.result, form)

    def _table(self, name: str, horner: Horner, form: Form) -> str:
        rows = "\n".join(f"    {row}" for row in self.rows(horner, form))
        return f"{name} = (\n{rows}\n)"

    def _points(self, form: Form) -> str:
        blocks = []
        for function in form.functions:
            rows = "\n".join(
                f"        ({', '.join(self.literal(x, form) for x in (*arguments, value))}),"
                for arguments, value in test_points(form, function)
            )
            blocks.append(f"    ({function.name}, (\n{rows}\n    )),")
        return "_POINTS = (\n" + "\n".join(blocks) + "\n)"

    def package(self, form: Form) -> dict[str, str]:
        project = (
            '[build-system]\nrequires = ["hatchling"]\nbuild-backend = "hatchling.build"\n\n'
            f'[project]\nname = "{form.name.replace("_", "-").lower()}"\nversion = "1.0.0"\n'
            f'requires-python = ">=3.10"\n{self.dependencies}\n'
            f'[tool.hatch.build.targets.wheel]\npackages = ["{form.name}"]\n'
        )
        run = "failed = made.self_test()\nprint(failed)\nsys.exit(failed != 0)\n"
        check = f"import sys\n\nimport {form.name} as made\n\n{run}"
        return {f"{form.name}/__init__.py": self.write(form), "pyproject.toml": project, "check.py": check}

    dependencies = 'optional-dependencies = { arrays = ["numpy"] }'

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:  # noqa: ARG002
        return ((tool, "check.py"),)


language = Python()
