"""JavaScript: an ES module, strict by itself, for Node and for pages; numbers are doubles and nothing is fused."""

from __future__ import annotations

import math

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.languages.language import Language
from ridgeback.symbolic.codegen.program import Form, Function, Horner

EMULATED = """\
const wholeBits = new BigInt64Array(1);
const wholeValue = new Float64Array(wholeBits.buffer);

function twoSum(a, b) {
  const s = a + b;
  const t = s - a;
  return [s, (a - (s - t)) + (b - t)];
}

// a*b + c in one rounding (S. Boldo and G. Melquiond, IEEE Trans. Computers 57, 2008: rounding to odd).
function fused(a, b, c) {
  const uh = a*b;
  let ah = 134217729*a;
  ah = ah - (ah - a);
  let bh = 134217729*b;
  bh = bh - (bh - b);
  const al = a - ah;
  const bl = b - bh;
  const ul = al*bl - (((uh - ah*bh) - al*bh) - ah*bl);
  const [th, tl] = twoSum(c, ul);
  const [vh, vl] = twoSum(uh, th);
  const [z, rest] = twoSum(tl, vl);
  wholeValue[0] = z;
  if (rest !== 0 && (wholeBits[0] & 1n) === 0n) {
    wholeBits[0] += (rest > 0) === (z > 0) ? 1n : -1n;
  }
  return vh + wholeValue[0];
}"""


class JavaScript(Language):
    """An ES module."""

    name, suffix = "javascript", "mjs"
    tool = ("node", "nodejs")

    def literal(self, value: float, form: Form) -> str:  # noqa: ARG002
        if math.isfinite(value):
            return repr(value)
        return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"

    def fused(self, a: str, b: str, c: str, form: Form) -> str:  # noqa: ARG002
        return f"fused({a}, {b}, {c})"

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"Math.sqrt({a})"

    def absolute(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"Math.abs({a})"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"Math.floor({a})"

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:  # noqa: ARG002
        return f"let {name} = {value};" if first else f"{name} = {value};"

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:
        name, term = horner.name, f"{table}[i]"
        step = self.fused(name, horner.at, term, form) if form.fused else f"{name}*{horner.at} + {term}"
        return [
            self.assign(name, f"{table}[0]", first=first, form=form),
            f"for (let i = 1; i < {len(horner.coefficients)}; i++) {{",
            f"  {name} = {step};",
            "}",
        ]

    def write(self, form: Form) -> str:
        parts = [
            "\n".join(map(self.remark, self.heading(form))),
            *([EMULATED] if form.fused else []),
            *(self._table(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
            *(part for f in form.functions for part in self._function(f, form)),
            self._check(form),
        ]
        return "\n\n".join(parts) + "\n"

    def _table(self, name: str, horner: Horner, form: Form) -> str:
        rows = "\n".join(f"  {row}" for row in self.rows(horner, form))
        return f"const {name} = Float64Array.of(\n{rows}\n);"

    def _function(self, function: Function, form: Form) -> list[str]:
        name, domain = function.name, function.domain
        names = [a.name for a in function.arguments]
        given = [
            a.name if a.default is None else f"{a.name} = {self.literal(a.default, form)}" for a in function.arguments
        ]
        low, high = self.literal(domain.low, form), self.literal(domain.high, form)
        comment = "\n".join(self.remark(line) for line in self.about(function))
        body = [f"  {line}" for line in self.body(function, form)]
        converted = ", ".join(f"Number({n})" for n in names)
        passed = "".join(f", {n}" for n in names[1:])
        others = "".join(f", {g}" for g in given[1:])
        return [
            "\n".join(
                [
                    f"export function {name}_unchecked({', '.join(given)}) {{",
                    *body,
                    f"  return {self.operand(function.result, form)};",
                    "}",
                ]
            ),
            f"{comment}\nexport function {name}({', '.join(given)}) {{\n"
            f"  return {domain.argument} >= {low} && {domain.argument} <= {high}"
            f" ? {name}_unchecked({converted}) : NaN;\n}}",
            f"// The same for an array; out may be {names[0]} itself when that is a Float64Array.\n"
            f"export function {name}_array({names[0]}, out = new Float64Array({names[0]}.length){others}) {{\n"
            f"  for (let i = 0; i < {names[0]}.length; i++) {{\n"
            f"    out[i] = {name}({names[0]}[i]{passed});\n  }}\n  return out;\n}}",
        ]

    def _check(self, form: Form) -> str:
        lines = [
            "// Number of entries of the self-test tables that do not come out bit for bit.",
            "export function self_test() {\n  let failed = 0;",
        ]
        for function in form.functions:
            count = len(function.arguments)
            rows = "\n".join(
                f"    [{', '.join(self.literal(x, form) for x in (*arguments, value))}],"
                for arguments, value in test_points(form, function)
            )
            given = ", ".join(f"p[{i}]" for i in range(count))
            others = "".join(f", p[{i}]" for i in range(1, count))
            lines += [
                f"  for (const p of [\n{rows}\n  ]) {{",
                f"    const value = {function.name}_array(Float64Array.of(p[0]), undefined{others})[0];",
                f"    if (!Object.is({function.name}({given}), p[{count}]) || !Object.is(value, p[{count}])) {{",
                "      failed += 1;",
                "    }",
                "  }",
            ]
        return "\n".join([*lines, "  return failed;\n}"])

    def package(self, form: Form) -> dict[str, str]:
        project = (
            f'{{\n  "name": "{form.name.lower()}",\n  "version": "1.0.0",\n  "type": "module",\n'
            '  "exports": "./index.mjs",\n  "scripts": {\n    "test": "node check.mjs"\n  }\n}\n'
        )
        check = (
            'import { self_test } from "./index.mjs";\n\nconst failed = self_test();\nconsole.log(failed);\n'
            "process.exit(failed === 0 ? 0 : 1);\n"
        )
        return {"index.mjs": self.write(form), "package.json": project, "check.mjs": check}

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:  # noqa: ARG002
        return ((tool, "check.mjs"),)


language = JavaScript()
