"""``ridgeback generate``: an expansion as source text, or as a package."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ridgeback.answers.resummation import resummed_from
from ridgeback.console.folder import write_folder
from ridgeback.console.output import STDOUT, json_text, write_text
from ridgeback.console.verb import Verb
from ridgeback.options.code import Code, coding
from ridgeback.options.demand import Demand
from ridgeback.options.derivation import Request, derived, requesting
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.system import Choice, choosing
from ridgeback.options.unused import refuse_unused

if TYPE_CHECKING:
    from ridgeback.interface.source import Derived
    from ridgeback.symbolic.codegen import Formula
    from ridgeback.symbolic.codegen.program import Form
    from ridgeback.symbolic.systems.oscillator import Oscillator


@click.command("generate", cls=Verb, short_help="Write an expansion as source code in eleven languages.")
@choosing
@coding
@requesting
@format_option("source", "json", default="source")
@output_option
def command(*, choice: Choice, code: Code, request: Request, style: str, output: str) -> None:
    """Write the frequency of SYSTEM as source text: functions of numbers and of arrays, with a self-test.

    Each exact coefficient is rounded once, to the nearest number, and what rounding can do to the result is proved
    over the whole domain and written beside it; outside the domain the functions return nan.  Parameters without a
    value become arguments, as do all small ones of a slow flow.  -o with a name that ends in / writes a package.

    \b
    ridgeback generate pendulum --order 12 --up-to 2.36 -o pendulum.py
    ridgeback generate pendulum --order 12 --language c --check -o pendulum.c
    ridgeback generate pendulum --order 12 --language rust -o pendulum/
    ridgeback generate damped-pendulum --order 6          omega0(a, mu) and growth_rate(a, mu)
    ridgeback generate pendulum --fit minimax --up-to 2.36 --tolerance 1e-11 --language c
    ridgeback generate pendulum --resummed agm --up-to 3.1 --language javascript
    ridgeback generate --equation "u'' + u + c*u**3 = 0"   omega0(A, c)
    """
    code.check_together()
    if output.endswith("/"):
        refuse_unused("a package", "style")
    oscillator = choice.oscillator()
    result, series = formula_of(oscillator, request, code)
    form = form_for(oscillator, series, result, code)
    from ridgeback.symbolic.codegen import packaged, written

    if code.check:
        checked(form, code.language)
    script = {f"{form.name}.gappa": gappa_of(form, output)} if code.gappa else {}
    if output.endswith("/"):
        write_folder(output, {**packaged(form, code.language), **script})
        return
    for text in script.values():
        write_text(str(Path(output).with_suffix(".gappa")), text)
    source = written(form, code.language)
    public = result if series is None or hasattr(result, "to_dict") else series
    described_so = {"language": code.language, **public.to_dict(), "source": source}  # type: ignore[union-attr]
    write_text(output, json_text(described_so) if style == "json" else source)


def formula_of(oscillator: Oscillator, request: Request, code: Code) -> tuple[Formula, Derived | None]:
    """The formula, and the series that it comes from where there is one."""
    if code.fit is not None:
        from ridgeback.symbolic.codegen.fit.fit import minimax
        from ridgeback.symbolic.codegen.number import REALS

        end, real = code.up_to or Fraction(0), REALS[code.real]
        return minimax(oscillator, end, degree=code.degree, tolerance=code.tolerance, real=real), None
    series = derived(oscillator, request)
    return _from_series(oscillator, series, code), series


def _from_series(oscillator: Oscillator, series: Derived, code: Code) -> Formula:
    """The series itself, or another formula in its place; raises InputError for one that has none."""
    from ridgeback.common.errors import InputError
    from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
    from ridgeback.symbolic.flow.loss_flow import LossFlow

    if code.resummed is None:
        return series
    if isinstance(series, PowerExpansion | LossFlow):
        raise InputError(series.refusal())
    if code.resummed in ("agm", "sine"):
        from ridgeback.symbolic.codegen.formulas.closed_forms import sine_series
        from ridgeback.symbolic.codegen.formulas.symbolic_mean import closed_form

        return closed_form(oscillator) if code.resummed == "agm" else sine_series(oscillator, code.terms or 1)
    at = None if code.up_to is None else (code.up_to,)
    demand = Demand(resummed=code.resummed, degrees=code.degrees, growth=code.growth, at=at)
    return resummed_from(oscillator, series, demand)


def form_for(oscillator: Oscillator, series: Derived | None, result: Formula, code: Code) -> Form:
    """The code with what is known about the formula: where the oscillation ends, and its certified error."""
    from ridgeback.interface.source import known_form

    return known_form(
        oscillator,
        series,
        result,
        up_to=code.up_to,
        name=code.name,
        mode=code.mode,  # type: ignore[arg-type]
        real=code.real,
        motion=code.motion,
    )


def checked(form: Form, language: str) -> None:
    """Build and run the self-test; a failure is ours, a missing tool is said on standard error.

    Raises RuntimeError when an entry of the table does not come out.
    """
    from ridgeback.compare.binding.generated_code import check

    found = check(form, language)
    if found.state == "failed":
        raise RuntimeError(f"the generated code fails its self-test: {found}")
    click.echo(f"self-test of the generated code: {found}", err=True)


def gappa_of(form: Form, output: str) -> str:
    """The script that stands beside a file; click.UsageError where there is no file."""
    from ridgeback.symbolic.codegen.proofs.gappa import gappa_script

    if output == STDOUT:
        raise click.UsageError("--gappa writes beside a file; name it with -o")
    return gappa_script(form)
