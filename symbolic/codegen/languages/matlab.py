"""MATLAB and Octave: one file whose function returns a structure of functions, all of them elementwise."""

from __future__ import annotations

import math

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.languages.language import Language
from ridgeback.symbolic.codegen.program import Form, Function, Horner

EMULATED = """\
function y = fused(a, b, c)
% a*b + c in one rounding (S. Boldo and G. Melquiond, IEEE Trans. Computers 57, 2008: rounding to odd).
  uh = a.*b;
  ah = 134217729.*a; ah = ah - (ah - a); al = a - ah;
  bh = 134217729.*b; bh = bh - (bh - b); bl = b - bh;
  ul = al.*bl - (((uh - ah.*bh) - al.*bh) - ah.*bl);
  [th, tl] = two_sum(c, ul);
  [vh, vl] = two_sum(uh, th);
  [z, rest] = two_sum(tl, vl);
  bits = typecast(z(:), 'int64');
  up = int64(2*((rest(:) > 0) == (z(:) > 0)) - 1);
  even = rest(:) ~= 0 & bitand(bits, int64(1)) == 0;
  bits(even) = bits(even) + up(even);
  y = vh + reshape(typecast(bits, 'double'), size(z));
end

function [s, e] = two_sum(a, b)
  s = a + b;
  t = s - a;
  e = (a - (s - t)) + (b - t);
end"""


class Matlab(Language):
    """A MATLAB file that Octave reads too."""

    name, suffix = "matlab", "m"
    comment = "%"
    times, over = ".*", "./"
    tool = ("octave-cli", "octave")

    def literal(self, value: float, form: Form) -> str:  # noqa: ARG002
        if math.isfinite(value):
            return repr(value)
        return "NaN" if math.isnan(value) else "Inf" if value > 0 else "-Inf"

    def fused(self, a: str, b: str, c: str, form: Form) -> str:  # noqa: ARG002
        return f"fused({a}, {b}, {c})"

    def root(self, a: str, form: Form) -> str:  # noqa: ARG002
        """The square root, which is not a number, and not complex, where ``a`` is negative."""
        return f"sqrt(abs({a})) + 0./({a} >= 0)"

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:  # noqa: ARG002
        return f"{name} = {value};"

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:  # noqa: ARG002
        name, term = horner.name, f"{table}(index)"
        step = self.fused(name, horner.at, term, form) if form.fused else f"{name}.*{horner.at} + {term}"
        rows = [f"  {row}" for row in self.rows(horner, form, separator="")]
        return [
            f"{table} = [",
            *rows,
            "];",
            f"{name} = {table}(1);",
            f"for index = 2:{len(horner.coefficients)}",
            f"  {name} = {step};",
            "end",
        ]

    def write(self, form: Form) -> str:
        public = [f"{f.name}{tail}" for f in form.functions for tail in ("", "_unchecked")]
        first = f"{self.remark(form.name.upper())}  {self.heading(form)[0]}"
        parts = [
            "\n".join(
                [
                    f"function functions = {form.name}()",
                    first,
                    *map(self.remark, self.heading(form)[1:]),
                    self.remark(f"Use: f = {form.name}(); f.{form.functions[0].name}(...)"),
                    *(f"  functions.{name} = @{name};" for name in (*public, "self_test")),
                    "end",
                ]
            ),
            *(part for f in form.functions for part in self._function(f, form)),
            *([EMULATED] if form.fused else []),
            self._check(form),
        ]
        return "\n\n".join(parts) + "\n"

    def _function(self, function: Function, form: Form) -> list[str]:
        name, domain = function.name, function.domain
        names = [a.name for a in function.arguments]
        listed = ", ".join(names)
        defaults = [
            f"  if nargin < {i + 1}, {a.name} = {self.literal(a.default, form)}; end"
            for i, a in enumerate(function.arguments)
            if a.default is not None
        ]
        low, high = self.literal(domain.low, form), self.literal(domain.high, form)
        comment = [self.remark(line) for line in self.about(function)]
        body = [f"  {line}" for line in self.body(function, form)]
        spread = (
            [f"  value = value.*ones(size({domain.argument}));"] if domain.argument in self.unread(function) else []
        )
        return [
            "\n".join(
                [
                    f"function value = {name}({listed})",
                    *comment,
                    *defaults,
                    *(f"  {n} = double({n});" for n in names),
                    f"  value = {name}_unchecked({listed});",
                    *spread,
                    f"  outside = ~({domain.argument} >= {low} & {domain.argument} <= {high}) | false(size(value));",
                    "  value(outside) = NaN;",
                    "end",
                ]
            ),
            "\n".join(
                [
                    f"function value = {name}_unchecked({listed})",
                    *defaults,
                    *body,
                    f"  value = {self.operand(function.result, form)};",
                    "end",
                ]
            ),
        ]

    def _check(self, form: Form) -> str:
        lines = [
            "function failed = self_test()",
            "% Number of entries of the self-test tables that do not come out bit for bit.",
            "  failed = 0;",
        ]
        for function in form.functions:
            width = len(function.arguments) + 1
            rows = "\n".join(
                f"    {', '.join(self.literal(x, form) for x in (*arguments, value))}"
                for arguments, value in test_points(form, function)
            )
            given = ", ".join(f"p(:, {i + 1})" for i in range(width - 1))
            one = ", ".join(f"p(i, {i + 1})" for i in range(width - 1))
            lines += [
                f"  p = [\n{rows}\n  ];",
                f"  value = {function.name}({given});",
                f"  expected = p(:, {width});",
                "  failed = failed + sum(~(value == expected | (isnan(value) & isnan(expected))));",
                "  for i = 1:size(p, 1)",
                f"    failed = failed + ~isequaln({function.name}({one}), expected(i));",
                "  end",
            ]
        return "\n".join([*lines, "end"])

    def package(self, form: Form) -> dict[str, str]:
        check = f"f = {form.name}();\nfailed = f.self_test();\nprintf('%d\\n', failed);\nexit(double(failed ~= 0));\n"
        return {f"{form.name}.m": self.write(form), f"check_{form.name}.m": check}

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:
        return ((tool, "--no-gui", "--quiet", "--norc", f"check_{form.name}.m"),)


language = Matlab()
