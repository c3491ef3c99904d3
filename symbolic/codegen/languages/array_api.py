"""Python by the array API standard: NumPy, JAX, PyTorch, CuPy, by the namespace of the array that is given."""

from __future__ import annotations

from ridgeback.symbolic.codegen.languages.python import Python
from ridgeback.symbolic.codegen.program import Form, Function, Horner

SUPPORT = '''\
def _namespace(*values):
    """The array library that an argument belongs to."""
    for value in values:
        if hasattr(value, "__array_namespace__"):
            return value.__array_namespace__()
        if type(value).__module__ == "numpy":
            import numpy

            return numpy  # before version 2, by the names that it has in common with the standard
    for value in values:
        if not isinstance(value, (int, float)):
            import array_api_compat

            return array_api_compat.array_namespace(value)
    raise TypeError("none of the arguments is an array; give one, e.g. of NumPy, JAX, PyTorch or CuPy")


def _real(xp, value):
    """An array of floating-point numbers: whole numbers become doubles, other floats keep their precision."""
    if isinstance(value, (int, float)):
        return float(value)
    if hasattr(value.dtype, "kind") and value.dtype.kind in "biu":
        return value.astype("float64")
    real = not hasattr(xp, "isdtype") or xp.isdtype(value.dtype, "real floating")
    return value if real else xp.astype(value, xp.float64)'''

SELF_TEST = '''\
def self_test():
    """Number of entries of the self-test tables that do not come out bit for bit with NumPy."""
    import numpy

    failed = 0
    for function, points in _POINTS:
        columns = numpy.asarray(points, dtype=numpy.float64).T
        value, expected = function(*columns[:-1]), columns[-1]
        failed += int(((value != expected) & ~(numpy.isnan(value) & numpy.isnan(expected))).sum())
    return failed'''


class ArrayApi(Python):
    """A Python module for arrays of any library that follows the standard."""

    name = "array-api"
    modes = ("strict", "accurate")
    in_place = False  # JAX's arrays do not change
    dependencies = 'dependencies = ["array-api-compat"]'

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:  # noqa: ARG002
        name = horner.name
        return [f"{name} = {table}[0]", f"for c in {table}[1:]:", f"    {name} = {name}*{horner.at} + c"]

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"_namespace({a}).sqrt({a})"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"_namespace({a}).floor({a})"

    def write(self, form: Form) -> str:
        names = ", ".join(f'"{f.name}{tail}"' for f in form.functions for tail in ("", "_unchecked"))
        parts = [
            "\n".join(['"""' + self.heading(form)[0], *self.heading(form)[1:], '"""', "", "import math"]),
            f'__all__ = [{names}, "self_test"]',
            *(part for f in form.functions for part in self._pair(f, form)),
            SUPPORT,
            *(self._table(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
            self._points(form),
            SELF_TEST,
        ]
        return "\n\n".join(parts[:2]) + "".join("\n\n\n" + part for part in parts[2:]) + "\n"

    def _pair(self, function: Function, form: Form) -> list[str]:
        names = ", ".join(a.name for a in function.arguments)
        domain, signature = function.domain, self.signature(function)
        low, high = self.literal(domain.low, form), self.literal(domain.high, form)
        document = "\n    ".join([f'"""{self.about(function)[0]}', "", *self.about(function)[1:], '"""'])
        inside = f"({domain.argument} >= {low}) & ({domain.argument} <= {high})"
        whole = f"{function.name}_unchecked({names}) + 0.0*({' + '.join(a.name for a in function.arguments)})"
        checked = [
            f"def {function.name}({signature}):",
            f"    {document}",
            f"    xp = _namespace({names})",
            *(f"    {a.name} = _real(xp, {a.name})" for a in function.arguments),
            f"    inside = {inside}",
            "    if isinstance(inside, bool):",
            f"        value = {function.name}_unchecked({names})",
            "        return value if inside else value + math.nan",
            f"    {domain.argument} = xp.where(inside, {domain.argument}, xp.full_like({domain.argument}, math.nan))",
            f"    value = {function.name}_unchecked({names})",
            "    if not hasattr(value, 'dtype'):",
            f"        value = {whole}",
            "    return xp.where(inside, value, xp.full_like(value, math.nan))",
        ]
        body = "\n    ".join([*self.body(function, form), f"return {self.result(function, form)}"])
        plain = (
            f"def {function.name}_unchecked({signature}):\n"
            f'    """The same by floating-point arithmetic alone, wherever the arguments lie."""\n    {body}'
        )
        return ["\n".join(checked), plain]


language = ArrayApi()
