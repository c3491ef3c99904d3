"""C99: hexadecimal constants, no dependency; a source file with its header, a Makefile and a check."""

from __future__ import annotations

import math
from typing import ClassVar

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.languages.language import Language
from ridgeback.symbolic.codegen.number import FLOAT32
from ridgeback.symbolic.codegen.program import Form, Function, Horner

GUARD = """\
#if defined(__FAST_MATH__)
#error "compile this file without -ffast-math: its bounds and its checks need IEEE 754 arithmetic"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD > 0
#error "compile this file for arithmetic in the precision of its types, e.g. with -msse2 -mfpmath=sse"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif"""
BLOCK = 64
"""Values that an array is worked on in at a time."""
FLAGS = ("-std=c99", "-O3", "-ffp-contract=off", "-Wall", "-Wextra", "-Wmissing-prototypes", "-pedantic")


class C(Language):
    """C99 functions, usable from C++ through their header."""

    name, suffix = "c", "c"
    reals: ClassVar[tuple[str, ...]] = ("float64", "float32")
    tool: ClassVar[tuple[str, ...]] = ("cc", "gcc", "clang")

    def kind(self, form: Form) -> str:
        """The type of all numbers."""
        return "float" if form.real is FLOAT32 else "double"

    def literal(self, value: float, form: Form) -> str:
        if math.isnan(value):
            return "NAN"
        if math.isinf(value):
            return "INFINITY" if value > 0 else "-INFINITY"
        return shorter_hex(value) + self.letter(form)

    def letter(self, form: Form) -> str:
        """The suffix of constants and library functions."""
        return "f" if form.real is FLOAT32 else ""

    def fused(self, a: str, b: str, c: str, form: Form) -> str:
        return f"fma{self.letter(form)}({a}, {b}, {c})"

    def root(self, a: str, form: Form) -> str:
        return f"sqrt{self.letter(form)}({a})"

    def absolute(self, a: str, form: Form) -> str:
        return f"fabs{self.letter(form)}({a})"

    def floor(self, a: str, form: Form) -> str:
        return f"floor{self.letter(form)}({a})"

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:
        return f"{self.kind(form)} {name} = {value};" if first else f"{name} = {value};"

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:
        length = len(horner.coefficients)
        term = f"{table}[n]"
        step = self.fused(horner.name, horner.at, term, form) if form.fused else f"{horner.name}*{horner.at} + {term}"
        return [
            self.assign(horner.name, f"{table}[0]", first=first, form=form),
            f"for (int n = 1; n < {length}; n++)",
            f"    {horner.name} = {step};",
        ]

    # --- the source ---

    def write(self, form: Form) -> str:
        return "\n\n".join([*self._functions(form), *self._self_test(form)]) + "\n"

    def untested(self, form: Form) -> str:
        """The source without its self-test."""
        return "\n\n".join(self._functions(form)) + "\n"

    def _functions(self, form: Form) -> list[str]:
        return [
            "\n".join(map(self.remark, self.heading(form))),
            "#include <float.h>\n#include <math.h>\n#include <stddef.h>",
            GUARD,
            *(self._table(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
            *(part for f in form.functions for part in self._function(f, form)),
        ]

    def header(self, form: Form) -> str:
        """The header file."""
        guard = f"RIDGEBACK_{form.name.upper()}_H"
        return "\n".join(
            [
                *map(self.remark, self.heading(form)),
                f"#ifndef {guard}\n#define {guard}\n\n#include <stddef.h>\n",
                '#ifdef __cplusplus\nextern "C" {\n#endif\n',
                *(line for f in form.functions for line in self._declared(f, form)),
                "// Number of entries of the self-test tables that do not come out bit for bit.",
                f"int {form.name}_self_test(void);\n",
                "#ifdef __cplusplus\n}\n#endif\n\n#endif\n",
            ]
        )

    def _declared(self, function: Function, form: Form) -> list[str]:
        comment = [self.remark(line) for line in self.about(function)]
        return [*comment, *(f"{s};" for s in self.signatures(function, form)), ""]

    def called(self, function: Function, form: Form) -> str:
        """The name of a function in the file."""
        return f"{form.name}_{function.name}"

    def signatures(self, function: Function, form: Form) -> tuple[str, str, str]:
        """Of the function, of the one that does not look at the domain, and of the one that fills an array."""
        kind, name = self.kind(form), self.called(function, form)
        plain = ", ".join(f"{kind} {a.name}" for a in function.arguments)
        others = "".join(f", {kind} {a.name}" for a in function.arguments[1:])
        array = f"void {name}_array(const {kind} *values, {kind} *out, size_t count{others})"
        return f"{kind} {name}({plain})", f"{kind} {name}_unchecked({plain})", array

    def _table(self, name: str, horner: Horner, form: Form) -> str:
        rows = "\n".join(f"    {row}" for row in self.rows(horner, form))
        return f"static const {self.kind(form)} {name}[{len(horner.coefficients)}] = {{\n{rows}\n}};"

    def _function(self, function: Function, form: Form) -> list[str]:
        checked, plain, array = self.signatures(function, form)
        names = ", ".join(a.name for a in function.arguments)
        comment = "\n".join(self.remark(line) for line in self.about(function))
        unread = [f"    {self.ignored(name)}" for name in self.unread(function)]
        body = [f"    {line}" for line in self.body(function, form)]
        called = self.called(function, form)
        return [
            f"{comment}\n" + "\n".join(f"{s};" for s in (checked, plain, array)),
            "\n".join([plain, "{", *unread, *body, f"    return {self.operand(function.result, form)};", "}"]),
            f"{checked}\n{{\n    return {self.inside(function, form)} ? {called}_unchecked({names}) : NAN;\n}}",
            f"{array}\n{self.array_body(function, form)}",
        ]

    def array_body(self, function: Function, form: Form, size: str = "size_t") -> str:
        """Blocks of values, then what lies outside the domain: so that compilers vectorise both loops."""
        kind, first = self.kind(form), function.arguments[0].name
        take = f"const {kind} {first} = values[start + i];"
        unread = [self.ignored(name) for name in self.unread(function)]
        body = [*unread, *self.body(function, form), f"block[i] = {self.operand(function.result, form)};"]
        domain_first = function.domain.argument == first
        lines = [
            "{",
            f"    {kind} block[{BLOCK}];",
            f"    for ({size} start = 0; start < count; start += {BLOCK}) {{",
            f"        const {size} stop = count - start < {BLOCK} ? count - start : {BLOCK};",
            f"        for ({size} i = 0; i < stop; i++) {{",
            f"            {take}",
            *(f"            {line}" for line in body),
            "        }",
            f"        for ({size} i = 0; i < stop; i++) {{",
            *([f"            {take}"] if domain_first else []),
            f"            out[start + i] = {self.inside(function, form)} ? block[i] : {self.literal(math.nan, form)};",
            "        }",
            "    }",
            "}",
        ]
        return "\n".join(lines)

    def ignored(self, name: str) -> str:
        """A statement that keeps a compiler from warning of an argument that is not read."""
        return f"(void){name};"

    def inside(self, function: Function, form: Form) -> str:
        """The condition that the argument lies in the domain; false for what is not a number."""
        domain = function.domain
        at = domain.argument
        if domain.low == -domain.high:
            return f"fabs{self.letter(form)}({at}) <= {self.literal(domain.high, form)}"
        return f"({at} >= {self.literal(domain.low, form)}) & ({at} <= {self.literal(domain.high, form)})"

    def _self_test(self, form: Form) -> list[str]:
        kind, name = self.kind(form), form.name
        parts, calls = [], []
        for function in form.functions:
            count = len(function.arguments)
            points = test_points(form, function)
            rows = ",\n".join(
                f"    {{{', '.join(self.literal(x, form) for x in (*arguments, value))}}}"
                for arguments, value in points
            )
            table = f"points_{function.name}"
            parts.append(f"static const {kind} {table}[{len(points)}][{count + 1}] = {{\n{rows}\n}};")
            given = ", ".join(f"p[{i}]" for i in range(count))
            others = "".join(f", p[{i}]" for i in range(1, count))
            called = self.called(function, form)
            calls += [
                f"    for (int i = 0; i < {len(points)}; i++) {{",
                f"        const {kind} *p = {table}[i];",
                f"        {kind} value = p[0];",
                f"        {called}_array(&value, &value, 1{others});",
                f"        failed += !self_same({called}({given}), p[{count}]) || !self_same(value, p[{count}]);",
                "    }",
            ]
        same = f"static int self_same({kind} a, {kind} b)\n{{\n    return a == b || (a != a && b != b);\n}}"
        comment = "// Number of entries of the self-test tables that do not come out bit for bit."
        signature = f"int {name}_self_test(void)"
        body = "\n".join(["{", "    int failed = 0;", *calls, "    return failed;", "}"])
        return [*parts, same, f"{comment}\n{signature};", f"{signature}\n{body}"]

    # --- the package ---

    def package(self, form: Form) -> dict[str, str]:
        check = (
            f'#include <stdio.h>\n\n#include "{form.name}.h"\n\n'
            f"int main(void)\n{{\n    int failed = {form.name}_self_test();\n"
            '    printf("%d\\n", failed);\n    return failed != 0;\n}\n'
        )
        make = (
            f"# The results hold bit for bit with these flags, and for every -march=.\nCFLAGS = {' '.join(FLAGS)}\n\n"
            f"{form.name}.o: {form.name}.c {form.name}.h\n\t$(CC) $(CFLAGS) -c {form.name}.c\n\n"
            f"check: {form.name}.o check.c\n\t$(CC) $(CFLAGS) -o check check.c {form.name}.o -lm\n\t./check\n\n"
            f"clean:\n\trm -f {form.name}.o check\n\n.PHONY: check clean\n"
        )
        return {
            f"{form.name}.c": self.write(form),
            f"{form.name}.h": self.header(form),
            "check.c": check,
            "Makefile": make,
        }

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:
        build = (tool, *FLAGS, "-Werror", "-o", "check", "check.c", f"{form.name}.c", "-lm")
        return (build, ("./check",))


class CHeader(C):
    """The header of the C source alone."""

    name, suffix, tool = "c-header", "h", ()

    def write(self, form: Form) -> str:
        return self.header(form)

    def package(self, form: Form) -> dict[str, str]:
        return {f"{form.name}.h": self.header(form)}

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:  # noqa: ARG002
        return ()


def shorter_hex(value: float) -> str:
    """A hexadecimal constant without zeros at its end.

    >>> shorter_hex(0.5), shorter_hex(-0.1)
    ('0x1p-1', '-0x1.999999999999ap-4')
    """
    head, _, tail = value.hex().partition("p")
    head = head.rstrip("0").rstrip(".") if "." in head else head
    return f"{head}p{int(tail)}"


language = C()
header = CHeader()
