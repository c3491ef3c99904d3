"""Python compiled by Numba: functions of numbers, and loops over arrays, that can be called from compiled code."""

from __future__ import annotations

from ridgeback.symbolic.codegen.languages.python import Python
from ridgeback.symbolic.codegen.program import Form, Function, Horner

SELF_TEST = '''\
def self_test():
    """Number of entries of the self-test tables that do not come out bit for bit."""
    failed = 0
    for function, array, points in _TESTS:
        for *given, expected in points:
            out = numpy.array([given[0]])
            array(out, out, *given[1:])
            failed += not all(v == expected or (v != v and expected != expected) for v in (function(*given), out[0]))
    return failed'''


class Numba(Python):
    """A Python module whose functions Numba compiles."""

    name = "numba"
    modes = ("strict", "accurate")
    in_place = False
    dependencies = 'dependencies = ["numba", "numpy"]'

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:  # noqa: ARG002
        name = horner.name
        return [f"{name} = 0.0", f"for c in {table}:", f"    {name} = {name}*{horner.at} + c"]

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"math.sqrt({a})"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"float(math.floor({a}))"

    def write(self, form: Form) -> str:
        names = ", ".join(f'"{f.name}{tail}"' for f in form.functions for tail in ("", "_array", "_unchecked"))
        imports = ["", "import math", "", "import numpy", "from numba import njit"]
        tests = "\n".join(f"    ({f.name}, {f.name}_array, _POINTS[{i}][1])," for i, f in enumerate(form.functions))
        parts = [
            "\n".join(['"""' + self.heading(form)[0], *self.heading(form)[1:], '"""', *imports]),
            f'__all__ = [{names}, "self_test"]',
            *(self._numbers(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
            *(part for f in form.functions for part in self._compiled(f, form)),
            self._points(form),
            f"_TESTS = (\n{tests}\n)",
            SELF_TEST,
        ]
        return "\n\n".join(parts[:2]) + "".join("\n\n\n" + part for part in parts[2:]) + "\n"

    def _numbers(self, name: str, horner: Horner, form: Form) -> str:
        rows = "\n".join(f"    {row}" for row in self.rows(horner, form))
        return f"{name} = numpy.array([\n{rows}\n])"

    def _compiled(self, function: Function, form: Form) -> list[str]:
        names, domain = [a.name for a in function.arguments], function.domain
        signature = self.signature(function)
        others, passed = signature.partition(", ")[2], "".join(f", {n}" for n in names[1:])
        low, high = self.literal(domain.low, form), self.literal(domain.high, form)
        converted = ", ".join(f"float({n})" for n in names)
        document = "\n    ".join([f'"""{self.about(function)[0]}', "", *self.about(function)[1:], '"""'])
        body = "\n    ".join([*self.body(function, form), f"return {self.result(function, form)}"])
        return [
            f"@njit\ndef {function.name}_unchecked({signature}):\n"
            f'    """The same by floating-point arithmetic alone, wherever the arguments lie."""\n    {body}',
            f"@njit\ndef {function.name}({signature}):\n    {document}\n"
            f"    if {low} <= {domain.argument} <= {high}:\n        return {function.name}_unchecked({converted})\n"
            "    return math.nan",
            f"@njit\ndef {function.name}_array({names[0]}, out{', ' + others if others else ''}):\n"
            f'    """The same for an array into ``out``, which may be ``{names[0]}`` itself."""\n'
            f"    for i in range({names[0]}.size):\n        out[i] = {function.name}({names[0]}[i]{passed})",
        ]


language = Numba()
