"""Fortran 2008: a module of pure elemental functions, lines within the 132 characters of free form."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Sequence

from ridgeback.symbolic.codegen.evaluation import test_points
from ridgeback.symbolic.codegen.languages.language import Language
from ridgeback.symbolic.codegen.lowering import operations
from ridgeback.symbolic.codegen.program import Form, Function, Horner

FLAGS = ("-std=f2008", "-O3", "-ffp-contract=off", "-fprotect-parens", "-Wall", "-Wextra", "-pedantic")
PIECE = 100
"""Values in one array constructor: a statement may have 255 continuation lines."""


FUSED = """\
  interface
    ! a*b + c in one rounding, from the mathematical library of C.
    pure function fused(a, b, c) bind(c, name="fma") result(result_value)
      use, intrinsic :: iso_c_binding, only: c_double
      real(c_double), value, intent(in) :: a, b, c
      real(c_double) :: result_value
    end function fused
  end interface"""


LONGEST = 96
"""Characters of a line, before what continues it; free form has 132."""


class Fortran(Language):
    """A Fortran module; as a package one that fpm builds."""

    name, suffix = "fortran", "f90"
    comment, end = "!", ""
    tool = ("gfortran",)

    def fused(self, a: str, b: str, c: str, form: Form) -> str:  # noqa: ARG002
        return f"fused({a}, {b}, {c})"

    def literal(self, value: float, form: Form) -> str:  # noqa: ARG002
        return f"{value!r}_wp"

    def floor(self, a: str, form: Form) -> str:  # noqa: ARG002
        return f"lower({a})"

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:  # noqa: ARG002
        return f"{name} = {value}"

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:  # noqa: ARG002
        name = horner.name
        term = f"{table}(i_table)"
        step = self.fused(name, horner.at, term, form) if form.fused else f"{name}*{horner.at} + {term}"
        return [f"{name} = {table}(1)", f"do i_table = 2, {len(horner.coefficients)}", f"  {name} = {step}", "end do"]

    def write(self, form: Form) -> str:
        public = [f"{f.name}{tail}" for f in form.functions for tail in ("", "_unchecked", "_array")]
        parts = [
            "\n".join(map(self.remark, self.heading(form))),
            f"module {form.name}\n"
            "  use, intrinsic :: iso_fortran_env, only: wp => real64, int64\n"
            "  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan\n"
            "  implicit none\n  private",
            "\n".join(f"  public :: {name}" for name in (*public, "self_test")),
            *(self._table(name, horner, form) for f in form.functions for name, horner in self.tables(f)),
            *(self._points(function, form) for function in form.functions),
            *([FUSED] if form.fused else []),
            "contains",
            *(part for f in form.functions for part in self._function(f, form)),
            *self._lower(form),
            self._check(form),
            f"end module {form.name}",
        ]
        source = "\n\n".join(parts) + "\n"
        return "".join(f"{folded(line)}\n" for line in source.splitlines())

    def _table(self, name: str, horner: Horner, form: Form) -> str:
        rows = []
        for coefficient in reversed(horner.coefficients):
            notes = [] if coefficient is None else list(self.noted("", [coefficient]))[:-1]
            notes = notes if coefficient is None or notes else [self.remark(str(coefficient))]
            rows.append((self.literal(coefficient.nearest if coefficient else 0.0, form), notes))
        return "\n".join(pieces(name, "real(wp)", rows))

    def _points(self, function: Function, form: Form) -> str:
        """Bit patterns, since Fortran has no constant for what is not a number."""
        values = [v for arguments, value in test_points(form, function) for v in (*arguments, value)]
        return "\n".join(pieces(f"points_{function.name}", "integer(int64)", [(pattern(v), []) for v in values]))

    def _function(self, function: Function, form: Form) -> list[str]:
        name, names = function.name, [a.name for a in function.arguments]
        listed, domain = ", ".join(names), function.domain
        about = [f"  {self.remark(line)}" for line in self.about(function)]
        declared = [f"    real(wp), intent(in) :: {', '.join(names)}"]
        local = sorted({step.name for step in operations(function, form)} - set(names), key=str.lower)
        loops = any(True for _ in self.tables(function))
        body = [f"    {line}" for line in self.body(function, form)]
        unread = [f"    if (.false.) value = {n}" for n in self.unread(function)]
        low, high = self.literal(domain.low, form), self.literal(domain.high, form)
        inside = f"{domain.argument} >= {low} .and. {domain.argument} <= {high}"
        others = "".join(f", {n}" for n in names[1:])
        return [
            "\n".join(
                [
                    f"  pure elemental function {name}_unchecked({listed}) result(value)",
                    *declared,
                    "    real(wp) :: value",
                    *(f"    real(wp) :: {n}" for n in local),
                    *(["    integer :: i_table"] if loops else []),
                    *unread,
                    *body,
                    f"    value = {self.operand(function.result, form)}",
                    f"  end function {name}_unchecked",
                ]
            ),
            "\n".join(
                [
                    *about,
                    f"  pure elemental function {name}({listed}) result(value)",
                    *declared,
                    "    real(wp) :: value",
                    f"    if ({inside}) then",
                    f"      value = {name}_unchecked({listed})",
                    "    else",
                    "      value = ieee_value(1.0_wp, ieee_quiet_nan)",
                    "    end if",
                    f"  end function {name}",
                ]
            ),
            "\n".join(
                [
                    "  ! The same for every number of an array, in place.",
                    f"  pure subroutine {name}_array(values{others})",
                    "    real(wp), intent(inout) :: values(:)",
                    *([f"    real(wp), intent(in) :: {', '.join(names[1:])}"] if names[1:] else []),
                    "    integer :: i_value",
                    "    do i_value = 1, size(values)",
                    f"      values(i_value) = {name}(values(i_value){others})",
                    "    end do",
                    f"  end subroutine {name}_array",
                ]
            ),
        ]

    def _lower(self, form: Form) -> Iterator[str]:
        if any(step.operation.value == "floor" for f in form.functions for step in operations(f, form)):
            yield (
                "  ! The next lower whole number, of any size.\n  pure elemental function lower(x) result(value)\n"
                "    real(wp), intent(in) :: x\n    real(wp) :: value\n    value = aint(x)\n"
                "    if (value > x) value = value - 1.0_wp\n  end function lower"
            )

    def _check(self, form: Form) -> str:
        lines = [
            "  ! Number of entries of the self-test tables that do not come out bit for bit.",
            "  function self_test() result(failed)",
            "    integer :: failed, i",
            f"    real(wp) :: p({max(len(f.arguments) for f in form.functions) + 1}), value(1)",
            "    failed = 0",
        ]
        for function in form.functions:
            width, table = len(function.arguments) + 1, f"points_{function.name}"
            given = ", ".join(f"p({i + 1})" for i in range(width - 1))
            others = "".join(f", p({i + 1})" for i in range(1, width - 1))
            lines += [
                f"    do i = 1, size({table}), {width}",
                f"      p(1:{width}) = transfer({table}(i:i+{width - 1}), p, {width})",
                "      value(1) = p(1)",
                f"      call {function.name}_array(value{others})",
                f"      if (.not. same({function.name}({given}), p({width}))) failed = failed + 1",
                f"      if (.not. same(value(1), p({width}))) failed = failed + 1",
                "    end do",
            ]
        same = (
            "  pure function same(x, y)\n    real(wp), intent(in) :: x, y\n    logical :: same\n"
            "    same = (x <= y .and. x >= y) .or. (.not. x <= huge(x) .and. .not. x >= -huge(x) &\n"
            "        .and. .not. y <= huge(y) .and. .not. y >= -huge(y))\n  end function same"
        )
        return "\n".join([*lines, "  end function self_test", "", same])

    def package(self, form: Form) -> dict[str, str]:
        name = form.name
        check = (
            f"program check\n  use {name}, only: self_test\n  implicit none\n  integer :: failed\n"
            "  failed = self_test()\n  print '(i0)', failed\n  if (failed /= 0) stop 1\nend program check\n"
        )
        fpm = (
            f'name = "{name}"\nversion = "1.0.0"\n\n[build]\nauto-tests = true\n\n'
            '# The results hold bit for bit with --flag "-ffp-contract=off", and for every -march=.\n'
        )
        return {f"src/{name}.f90": self.write(form), "test/check.f90": check, "fpm.toml": fpm}

    def commands(self, form: Form, tool: str) -> tuple[tuple[str, ...], ...]:
        return ((tool, *FLAGS, "-Werror", "-o", "check", f"src/{form.name}.f90", "test/check.f90"), ("./check",))


def folded(line: str) -> str:
    """A statement in lines of free form, broken behind commas.

    >>> print(folded("call f(" + ", ".join(["argument"] * 12) + ")"))
    call f(argument, argument, argument, argument, argument, argument, argument, argument, argument, &
        argument, argument, argument)
    """
    if "!" in line or line.endswith("&"):
        return line  # a comment, a short statement with one, or a statement in lines already
    parts, here = [], ""
    for piece in line.split(", "):
        if here and len(here) + len(piece) > LONGEST:
            parts.append(f"{here}, &")
            here = f"    {' ' * (len(line) - len(line.lstrip()))}{piece}"
        else:
            here = f"{here}, {piece}" if here else piece
    return "\n".join([*parts, here])


def pieces(name: str, kind: str, rows: Sequence[tuple[str, list[str]]]) -> list[str]:
    """An array constant of any length, in parts that are short enough for one statement each; notes stand above."""
    parts = [rows[i : i + PIECE] for i in range(0, len(rows), PIECE)]
    names = [name] if len(parts) == 1 else [f"{name}_{n + 1}" for n in range(len(parts))]
    lines = []
    for part, each in zip(parts, names, strict=True):
        lines += [f"  {note}" for _, notes in part for note in notes]
        lines.append(f"  {kind}, parameter :: {each}({len(part)}) = [ &")
        lines += [
            f"    {value}{',' if i < len(part) - 1 else ' ]'}{' &' if i < len(part) - 1 else ''}"
            for i, (value, _) in enumerate(part)
        ]
    if len(parts) > 1:
        joined = ", &\n    ".join(names)
        lines.append(f"  {kind}, parameter :: {name}({len(rows)}) = [{joined}]")
    return lines


def pattern(value: float) -> str:
    """The bits of a double as a whole number; of -0 those of 0, since standard Fortran has no whole number for them.

    >>> pattern(1.0), pattern(-0.0)
    ('4607182418800017408_int64', '0_int64')
    """
    bits = struct.unpack("<q", struct.pack("<d", math.nan if math.isnan(value) else value + 0.0))[0]
    return f"{bits}_int64"


language = Fortran()
