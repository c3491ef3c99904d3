"""Julia: a module of functions of Float64; Julia never fuses a product with a sum by itself."""

from __future__ import annotations

import math

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.languages.language import Language
from ridgeback.symbolic.codegen.program import Form, Function, Horner

UUID = "{0}-{1}-4{2}-8{3}-{4}"


class Julia(Language):
    """A Julia module; as a package one with a project file and a test."""

    name, suffix = "julia", "jl"
    comment, end = "#", ""
    tool = ("julia",)

    def literal(self, value: float, form: Form) -> str:  # noqa: ARG002
        if math.isfinite(value):
            return repr(value)  # a decimal point or exponent makes it a Float64, never a big number
        return "NaN" if math.isnan(value) else "Inf" if value > 0 else "-Inf"

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:  # noqa: ARG002
        return f"{name} = {value}"

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:  # noqa: ARG002
        name, length = horner.name, len(horner.coefficients)
        term = f"{table}[i]"
        step = self.fused(name, horner.at, term, form) if form.fused else f"{name}*{horner.at} + {term}"
        return [f"{name} = {table}[1]", f"@inbounds for i in 2:{length}", f"    {name} = {step}", "end"]

    def module(self, form: Form) -> str:
        """Modules begin with a capital."""
        return form.name[0].upper() + form.name[1:]

    def write(self, form: Form) -> str:
        names = ", ".join(f"{f.name}{tail}" for f in form.functions for tail in ("", "_unchecked", "_array!"))
        parts = [
            "\n".join(map(self.remark, self.heading(form))),
            f"module {self.module(form)}\n\nexport {names}",
            *(self._table(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
            *(part for f in form.functions for part in self._function(f, form)),
            self._check(form),
            "end",
        ]
        return "\n\n".join(parts) + "\n"

    def _table(self, name: str, horner: Horner, form: Form) -> str:
        rows = "\n".join(f"    {row}" for row in self.rows(horner, form))
        return f"const {name} = (\n{rows}\n)"

    def _function(self, function: Function, form: Form) -> list[str]:
        name, domain = function.name, function.domain
        typed = ", ".join(f"{a.name}::Float64" for a in function.arguments)
        loose = ", ".join(
            f"{a.name}::Real" + ("" if a.default is None else f"={self.literal(a.default, form)}")
            for a in function.arguments
        )
        names = [a.name for a in function.arguments]
        others = ", ".join(
            f"{a.name}::Real" + ("" if a.default is None else f"={self.literal(a.default, form)}")
            for a in function.arguments[1:]
        )
        body = [f"    {line}" for line in self.body(function, form)]
        comment = "\n".join(self.remark(line) for line in self.about(function))
        low, high = self.literal(domain.low, form), self.literal(domain.high, form)
        passed = "".join(f", {n}" for n in names[1:])
        converted = ", ".join(f"Float64({n})" for n in names)
        head = f"function {name}_unchecked({typed})"
        return [
            "\n".join([head, *body, f"    return {self.operand(function.result, form)}", "end"]),
            f"{comment}\nfunction {name}({loose})\n    {low} <= {domain.argument} <= {high} || return NaN\n"
            f"    return {name}_unchecked({converted})\nend",
            f"# The same into out, which may be {names[0]} itself.\n"
            f"function {name}_array!(out, {names[0]}{', ' + others if others else ''})\n"
            f"    @inbounds for i in eachindex(out, {names[0]})\n        out[i] = {name}({names[0]}[i]{passed})\n"
            "    end\n    return out\nend",
        ]

    def _check(self, form: Form) -> str:
        lines = [
            "# Number of entries of the self-test tables that do not come out bit for bit.",
            "function self_test()\n    failed = 0",
        ]
        for function in form.functions:
            count, points = len(function.arguments), test_points(form, function)
            rows = "\n".join(
                f"        ({', '.join(self.literal(x, form) for x in (*arguments, value))}),"
                for arguments, value in points
            )
            given = ", ".join(f"p[{i + 1}]" for i in range(count))
            others = "".join(f", p[{i + 1}]" for i in range(1, count))
            lines += [
                f"    for p in (\n{rows}\n    )",
                "        value = [p[1]]",
                f"        {function.name}_array!(value, value{others})",
                f"        failed += !isequal({function.name}({given}), p[{count + 1}]) || "
                f"!isequal(value[1], p[{count + 1}])",
                "    end",
            ]
        return "\n".join([*lines, "    return failed\nend"])

    def package(self, form: Form) -> dict[str, str]:
        module, d = self.module(form), (form.digest * 2)[:32]
        uuid = UUID.format(d[:8], d[8:12], d[13:16], d[17:20], d[20:32])
        project = f'name = "{module}"\nuuid = "{uuid}"\nversion = "1.0.0"\n\n[compat]\njulia = "1.6"\n'
        check = (
            f'include(joinpath(@__DIR__, "..", "src", "{module}.jl"))\n\nfailed = {module}.self_test()\n'
            "println(failed)\nexit(failed == 0 ? 0 : 1)\n"
        )
        return {f"src/{module}.jl": self.write(form), "Project.toml": project, "test/runtests.jl": check}

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:  # noqa: ARG002
        return ((tool, "--startup-file=no", "test/runtests.jl"),)


language = Julia()
