"""C++17: one header of inline functions in a namespace of their own."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.languages.c import GUARD, C
from ridgeback.symbolic.codegen.program import Form, Function

FLAGS = ("-std=c++17", "-O3", "-ffp-contract=off", "-Wall", "-Wextra", "-pedantic")


class Cpp(C):
    """A C++17 header."""

    name, suffix = "cpp", "hpp"
    reals = ("float64",)
    tool = ("c++", "g++", "clang++")

    def literal(self, value: float, form: Form) -> str:
        if math.isfinite(value):
            return super().literal(value, form)
        limits = "std::numeric_limits<double>::"
        return f"{limits}quiet_NaN()" if math.isnan(value) else f"{'-' if value < 0 else ''}{limits}infinity()"

    def fused(self, a: str, b: str, c: str, form: Form) -> str:  # noqa: ARG002
        return f"std::fma({a}, {b}, {c})"

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"std::sqrt({a})"

    def absolute(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"std::fabs({a})"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"std::floor({a})"

    def write(self, form: Form) -> str:
        guard = f"RIDGEBACK_{form.name.upper()}_HPP"
        parts = [
            "\n".join(map(self.remark, self.heading(form))),
            f"#ifndef {guard}\n#define {guard}",
            "#include <cfloat>\n#include <cmath>\n#include <cstddef>\n#include <limits>",
            GUARD,
            f"namespace {form.name} {{",
            *(self._constants(form)),
            *(part for f in form.functions for part in self._inline(f, form)),
            self._check(form),
            f"}}  // namespace {form.name}\n\n#endif",
        ]
        return "\n\n".join(parts) + "\n"

    def _constants(self, form: Form) -> Iterator[str]:
        for function in form.functions:
            for name, horner in self.tables(function):
                rows = "\n".join(f"    {row}" for row in self.rows(horner, form))
                yield f"inline constexpr double {name}[{len(horner.coefficients)}] = {{\n{rows}\n}};"

    def _inline(self, function: Function, form: Form) -> Iterator[str]:
        comment = "\n".join(self.remark(line) for line in self.about(function))
        given = ", ".join(
            f"double {a.name}" + ("" if a.default is None else f" = {self.literal(a.default, form)}")
            for a in function.arguments
        )
        names = ", ".join(a.name for a in function.arguments)
        others = given.partition(", ")[2]
        unread = [f"    {self.ignored(name)}" for name in self.unread(function)]
        body = [f"    {line}" for line in self.body(function, form)]
        result = self.operand(function.result, form)
        yield "\n".join(
            [f"inline double {function.name}_unchecked({given})", "{", *unread, *body, f"    return {result};", "}"]
        )
        nan = self.literal(math.nan, form)
        inside = self.inside(function, form)
        yield (
            f"{comment}\ninline double {function.name}({given})\n{{\n"
            f"    return {inside} ? {function.name}_unchecked({names}) : {nan};\n}}"
        )
        yield (
            "// The same for an array; out may be values itself.\n"
            f"inline void {function.name}_array(const double *values, double *out, std::size_t count"
            f"{', ' + others if others else ''})\n{self.array_body(function, form, 'std::size_t')}"
        )

    def ignored(self, name: str) -> str:
        return f"static_cast<void>({name});"

    def inside(self, function: Function, form: Form) -> str:
        return super().inside(function, form).replace("fabs", "std::fabs")

    def _check(self, form: Form) -> str:
        lines = [
            "// Number of entries of the self-test tables that do not come out bit for bit.",
            "inline int self_test()\n{\n    int failed = 0;",
            "    const auto same = [](double x, double y) { return x == y || (x != x && y != y); };",
        ]
        for function in form.functions:
            count, points = len(function.arguments), test_points(form, function)
            rows = ",\n".join(
                f"        {{{', '.join(self.literal(x, form) for x in (*arguments, value))}}}"
                for arguments, value in points
            )
            given = ", ".join(f"p[{i}]" for i in range(count))
            others = "".join(f", p[{i}]" for i in range(1, count))
            lines += [
                f"    static const double points_{function.name}[][{count + 1}] = {{\n{rows}\n    }};",
                f"    for (const auto &p : points_{function.name}) {{",
                "        double value = p[0];",
                f"        {function.name}_array(&value, &value, 1{others});",
                f"        failed += !same({function.name}({given}), p[{count}]) || !same(value, p[{count}]);",
                "    }",
            ]
        return "\n".join([*lines, "    return failed;\n}"])

    def package(self, form: Form) -> dict[str, str]:
        check = (
            f'#include <cstdio>\n\n#include "{form.name}.hpp"\n\nint main()\n{{\n'
            f"    const int failed = {form.name}::self_test();\n"
            '    std::printf("%d\\n", failed);\n    return failed != 0;\n}\n'
        )
        make = (
            f"# The results hold bit for bit with these flags, and for every -march=.\nCXXFLAGS = {' '.join(FLAGS)}\n\n"
            f"check: check.cpp {form.name}.hpp\n\t$(CXX) $(CXXFLAGS) -o check check.cpp\n\t./check\n\n"
            "clean:\n\trm -f check\n\n.PHONY: check clean\n"
        )
        return {f"{form.name}.hpp": self.write(form), "check.cpp": check, "Makefile": make}

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:  # noqa: ARG002
        return ((tool, *FLAGS, "-Werror", "-o", "check", "check.cpp"), ("./check",))


language = Cpp()
