"""Rust: a module of plain functions; Rust never fuses a product with a sum by itself."""

from __future__ import annotations

import math
import struct

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.languages.language import Language
from ridgeback.symbolic.codegen.number import FLOAT32
from ridgeback.symbolic.codegen.program import Form, Function, Horner


class Rust(Language):
    """A Rust module; as a package a crate without dependencies."""

    name, suffix = "rust", "rs"
    reals = ("float64", "float32")
    tool = ("rustc",)

    def kind(self, form: Form) -> str:
        """The type of all numbers."""
        return "f32" if form.real is FLOAT32 else "f64"

    def literal(self, value: float, form: Form) -> str:
        kind = self.kind(form)
        if math.isfinite(value):
            return f"{shortest_single(value) if form.real is FLOAT32 else repr(value)}_{kind}"
        return f"{kind}::NAN" if math.isnan(value) else f"{kind}::INFINITY" if value > 0 else f"{kind}::NEG_INFINITY"

    def fused(self, a: str, b: str, c: str, form: Form) -> str:  # noqa: ARG002
        return f"({a}).mul_add({b}, {c})" if a.startswith("-") else f"{a}.mul_add({b}, {c})"

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"{a}.sqrt()"

    def absolute(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"{a}.abs()"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"{a}.floor()"

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:
        return f"let mut {name}: {self.kind(form)} = {value};" if first else f"{name} = {value};"

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:
        name, upper = horner.name, table.upper()
        step = self.fused(name, horner.at, "c", form) if form.fused else f"{name}*{horner.at} + c"
        return [
            self.assign(name, f"{upper}[0]", first=first, form=form),
            f"for &c in {upper}[1..].iter() {{",
            f"    {name} = {step};",
            "}",
        ]

    def write(self, form: Form) -> str:
        parts = [
            "\n".join(f"//! {line}".rstrip() for line in self.heading(form)),
            "#![allow(unused_mut, clippy::all)]",
            *(self._table(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
            *(part for f in form.functions for part in self._function(f, form)),
            self._check(form),
        ]
        return "\n\n".join(parts) + "\n"

    def _table(self, name: str, horner: Horner, form: Form) -> str:
        rows = "\n".join(f"    {row}" for row in self.rows(horner, form))
        return f"static {name.upper()}: [{self.kind(form)}; {len(horner.coefficients)}] = [\n{rows}\n];"

    def _function(self, function: Function, form: Form) -> list[str]:
        kind, name = self.kind(form), function.name
        comment = "\n".join(f"/// {line}".rstrip() for line in self.about(function))
        signature = ", ".join(f"{a.name}: {kind}" for a in function.arguments)
        names = [a.name for a in function.arguments]
        unread = [f"    let _ = {n};" for n in self.unread(function)]
        body = [f"    {line}" for line in self.body(function, form)]
        first, others = names[0], "".join(f", {a.name}: {kind}" for a in function.arguments[1:])
        passed = "".join(f", {n}" for n in names[1:])
        result = self.operand(function.result, form)
        allowed = "#[allow(non_snake_case, dead_code)]"
        return [
            "\n".join(
                [
                    "/// The same by floating-point arithmetic alone, wherever the arguments lie.",
                    f"{allowed}\n#[inline]",
                    f"pub fn {name}_unchecked({signature}) -> {kind} {{",
                    *unread,
                    *body,
                    f"    {result}",
                    "}",
                ]
            ),
            f"{comment}\n{allowed}\n#[inline]\npub fn {name}({signature}) -> {kind} {{\n"
            f"    if {self.inside(function, form)} {{\n        {name}_unchecked({', '.join(names)})\n"
            f"    }} else {{\n        {kind}::NAN\n    }}\n}}",
            f"/// The same for every number of a slice, in place.\n{allowed}\n"
            f"pub fn {name}_array(values: &mut [{kind}]{others}) {{\n    for value in values.iter_mut() {{\n"
            f"        let {first} = *value;\n        let result = {name}_unchecked({first}{passed});\n"
            f"        *value = if {self.inside(function, form)} {{ result }} else {{ {kind}::NAN }};\n    }}\n}}",
        ]

    def inside(self, function: Function, form: Form) -> str:
        """The condition that the argument lies in the domain; false for what is not a number."""
        domain = function.domain
        if domain.low == -domain.high:
            return f"{domain.argument}.abs() <= {self.literal(domain.high, form)}"
        low, high = (self.literal(end, form) for end in (domain.low, domain.high))
        return f"{domain.argument} >= {low} && {domain.argument} <= {high}"

    def _check(self, form: Form) -> str:
        kind = self.kind(form)
        lines = [
            "/// Number of entries of the self-test tables that do not come out bit for bit.",
            "#[allow(dead_code)]\npub fn self_test() -> usize {\n    let mut failed = 0;",
            f"    let same = |x: {kind}, y: {kind}| x == y || (x.is_nan() && y.is_nan());",
        ]
        for function in form.functions:
            count, points = len(function.arguments), test_points(form, function)
            rows = "\n".join(
                f"        [{', '.join(self.literal(x, form) for x in (*arguments, value))}],"
                for arguments, value in points
            )
            given = ", ".join(f"p[{i}]" for i in range(count))
            others = "".join(f", p[{i}]" for i in range(1, count))
            lines += [
                f"    let points: [[{kind}; {count + 1}]; {len(points)}] = [\n{rows}\n    ];",
                "    for p in points.iter() {",
                "        let mut value = [p[0]];",
                f"        {function.name}_array(&mut value{others});",
                f"        if !same({function.name}({given}), p[{count}]) || !same(value[0], p[{count}]) {{",
                "            failed += 1;",
                "        }",
                "    }",
            ]
        return "\n".join([*lines, "    failed\n}"])

    def package(self, form: Form) -> dict[str, str]:
        crate = form.name.lower()
        tests = (
            "\n#[cfg(test)]\nmod tests {\n    #[test]\n    fn every_entry_comes_out_bit_for_bit() {\n"
            "        assert_eq!(super::self_test(), 0);\n    }\n}\n"
        )
        cargo = f'[package]\nname = "{crate}"\nversion = "1.0.0"\nedition = "2021"\n\n[dependencies]\n'
        main = (
            f'#[path = "../src/lib.rs"]\nmod {crate};\n\nfn main() {{\n    let failed = {crate}::self_test();\n'
            '    println!("{}", failed);\n    std::process::exit(if failed == 0 { 0 } else { 1 });\n}\n'
        )
        return {"Cargo.toml": cargo, "src/lib.rs": self.write(form) + tests, "examples/check.rs": main}

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:  # noqa: ARG002
        return ((tool, "-O", "-D", "warnings", "--edition", "2021", "-o", "check", "examples/check.rs"), ("./check",))


def shortest_single(value: float) -> str:
    """The shortest decimal that reads back as the same single-precision number.

    >>> shortest_single(0.10000000149011612), shortest_single(1.0)
    ('0.1', '1.0')
    """
    for digits in range(1, 10):
        text = f"{value:.{digits}g}"
        if struct.unpack("f", struct.pack("f", float(text)))[0] == value:
            break
    return repr(float(text))


language = Rust()
