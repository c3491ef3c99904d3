"""``ridgeback report``: the whole comparison as one HTML page."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ridgeback.answers.report_text import printed, refuse_incomplete
from ridgeback.common.progress import Progress, showing
from ridgeback.console.failure import say
from ridgeback.console.output import STDOUT, output_path, write_text
from ridgeback.console.verb import Verb
from ridgeback.options.arguments import GRID, ORDER, ORDERS, PAIR, POSITIVE
from ridgeback.options.recording import Reading, Treatment, band_option, decimal_option, treatment_options
from ridgeback.options.shared import drift_option, format_option, refuse_twice, unique
from ridgeback.options.study import STORE
from ridgeback.options.system import Choice, choosing
from ridgeback.options.unused import refuse_unused

if TYPE_CHECKING:
    from ridgeback.compare.motion.motion import Setting
    from ridgeback.compare.report.results import Report
    from ridgeback.symbolic.systems.oscillator import Oscillator

DEFAULT_NAME = "ridgeback-report.html"


@dataclass(frozen=True)
class Motion:
    """What is to be simulated, as far as it was said."""

    choice: Choice
    initial: tuple[float, float] | None
    duration: float | None
    rate: float | None
    title: str | None = None


@dataclass(frozen=True)
class Scope:
    """What is to be derived and studied, as far as it was said."""

    order: int | None
    orders: tuple[int, ...] | None
    amplitudes: tuple[float, ...] | None
    target: float | None
    trials: int
    timed: bool = True


@dataclass(frozen=True)
class Source:
    """Recordings, where their samples are, and how many of the first cycles of one predict the rest."""

    files: tuple[str, ...]
    column: str | None
    time_column: str | None
    run_column: str | None
    decimal: str | None
    cycles: float | None
    treatment: Treatment
    band: tuple[float, float] | None


@click.command("report", cls=Verb, short_help="Write the comparison as one HTML page.")
@choosing
@drift_option
@click.option("--initial", type=PAIR, default=None, metavar="U,V", help="State at time 0.")
@click.option("--duration", type=POSITIVE, default=None, metavar="T", help="Time to integrate over.")
@click.option("--rate", type=POSITIVE, default=None, metavar="R", help="Samples per time unit, also of a recording.")
@click.option(
    "--order",
    type=ORDER,
    default=None,
    metavar="N",
    help="The expansion that code and formulas are about.  Default: 20.",
)
@click.option("--orders", type=ORDERS, default=None, metavar="N,N,...", help="Orders of the accuracy study.")
@click.option("--amplitudes", type=GRID, default=None, metavar="START:STOP:COUNT", help="Amplitudes of the study.")
@click.option("--target", type=POSITIVE, default=None, metavar="E", help="Relative error aimed at.  Default: 0.001.")
@click.option(
    "--recording",
    "recordings",
    multiple=True,
    metavar="FILE",
    help="Report on a recording instead: CSV, NPZ, WAV, MAT, HDF5.  Repeat it for several runs on one page.",
)
@click.option(
    "--column",
    default=None,
    metavar="NAME[,NAME...]",
    help='The recording\'s samples; several names, or "all", for several channels on one page.',
)
@click.option("--time-column", default=None, metavar="NAME", help="The recording's times.")
@click.option("--run-column", default=None, metavar="NAME", help="The column that numbers runs, all on one page.")
@band_option
@decimal_option
@treatment_options
@click.option(
    "--predict-from", type=POSITIVE, default=None, metavar="CYCLES", help="Predict the rest of a recording from these."
)
@click.option(
    "--trials",
    type=click.IntRange(0, 1000),
    default=4,
    show_default=True,
    metavar="N",
    help="Noisy records a point of the noise study; 0 leaves it out, else at least 2.",
)
@click.option(
    "-o",
    "--output",
    type=output_path,
    default=DEFAULT_NAME,
    show_default=True,
    metavar="FILE",
    help="Where to write the page; - is standard output.",
)
@click.option("--title", default=None, metavar="TEXT", help="What the system is called on the page.")
@click.option("--no-timings", is_flag=True, help="Leave out measured times: the same request gives the same bytes.")
@click.option("--pdf", type=output_path, default=None, metavar="FILE", help="Print the page to a PDF too, by Chromium.")
@click.option("--open", "opened", is_flag=True, help="Show the page in the browser when it is written.")
@format_option("text", "json", default="text")
@click.pass_context
def command(
    context: click.Context,
    *,
    choice: Choice,
    laws: tuple[tuple[str, str], ...],
    initial: tuple[float, float] | None,
    duration: float | None,
    rate: float | None,
    order: int | None,
    orders: tuple[int, ...] | None,
    amplitudes: tuple[float, ...] | None,
    target: float | None,
    recordings: tuple[str, ...],
    column: str | None,
    time_column: str | None,
    run_column: str | None,
    decimal: str | None,
    band: tuple[float, float] | None,
    predict_from: float | None,
    treatment: Treatment,
    trials: int,
    title: str | None,
    no_timings: bool,
    pdf: str | None,
    opened: bool,
    style: str,
    output: str,
) -> None:
    """Compare expansions, models and estimated frequencies of SYSTEM, of a recording, or of a study, on one HTML page.

    Without an argument: the damped pendulum of Galleani and Cohen, k = 4 pi, mu = 0.01, from 0.95 pi at rest.  With
    a recording, SYSTEM is optional and its exact backbone is drawn over the measured one; the oscillators that could
    have made it are ranked.  The store of a study (.db) becomes a page of its answers, a folder of reports an
    index.  With --drift the page holds omega0 at the conserved action against the motion integrated under the drift.

    \b
    ridgeback report
    ridgeback report damped-duffing --set mu=0.02 --initial 1.5,0 --duration 60 -o duffing.html
    ridgeback report --recording decay.csv --column displacement -o decay.html
    ridgeback report --equation "x'' + 9.81/L*sin(x) = 0" --drift "L=1+0.01*t" --initial 1,0 -o swing.html
    ridgeback report --recording first.csv --recording second.csv -o runs.html
    ridgeback report five.db -o five.html
    ridgeback report reports/ -o reports/index.html
    """
    if trials == 1:
        raise click.UsageError("--trials 1 shows no spread; use at least 2, or 0 for no noise study")
    if output == STDOUT:
        refuse_unused("-o -, which prints the page itself,", "style", "pdf", "opened")
    if not choice.made:
        refuse_unused("a report without a SYSTEM", "about", "potential")
    motion = Motion(choice, initial, duration, rate, title)
    scope = Scope(order, orders, amplitudes, target, trials, not no_timings)
    shown = as_typed(context.find_root().obj or ("report",))
    with showing(True) as progress:
        if choice.system is not None and Path(choice.system).is_dir():
            refuse_unused("an index of a folder", *(name for name in context.params if name not in BESIDE_A_STORE))
            report = of_folder(choice.system, output, shown)
        elif (choice.system or "").endswith(STORE):
            refuse_beside_a_store(context)
            report = of_study(str(choice.system), shown, progress)
        elif laws:
            refuse_unused("a report on a drift", *(name for name in context.params if name not in BESIDE_A_DRIFT))
            report = of_drift(motion, unique(laws, "--drift"), shown, progress, timed=not no_timings)
        elif not recordings:
            places = {"--column": column, "--time-column": time_column, "--run-column": run_column, "--band": band}
            treating = {f"--{name}": value for name, value in {"decimal": decimal, **treatment.given()}.items()}
            refuse({**places, "--predict-from": predict_from, **treating}, "belongs to --recording FILE")
            report = of_motion(motion, scope, shown, progress)
        else:
            source = Source(recordings, column, time_column, run_column, decimal, predict_from, treatment, band)
            report = of_recordings(source, motion, scope, shown, progress)
    try:
        publish(report, output, style)
    finally:
        show(output, pdf, opened=opened)


BESIDE_A_DRIFT = (
    *("system", "equation", "about", "potential", "assignments", "laws", "initial", "duration", "rate", "title"),
    *("output", "no_timings", "pdf", "opened", "style"),
)
"""What may stand beside a drift, whose page holds one motion and no study."""


def of_drift(motion: Motion, laws: Mapping[str, str], shown: str, progress: Progress, *, timed: bool) -> Report:
    """The report on a motion whose parameters drift."""
    from ridgeback.compare.report.drift.drift_report import drift_report

    if not motion.choice.made:
        raise click.UsageError("--drift needs a SYSTEM whose parameter changes; name one, or give --equation")
    refuse_twice(motion.choice.assignments, laws)
    return drift_report(
        entitled(motion.choice.oscillator(), motion.title),
        laws,
        initial=motion.initial,
        duration=motion.duration,
        rate=motion.rate,
        timed=timed,
        command=shown,
        progress=progress,
    )


BESIDE_A_STORE = ("system", "output", "no_timings", "pdf", "opened", "style")
"""What may stand beside the store of a study, which holds all the rest."""


def refuse_beside_a_store(context: click.Context) -> None:
    """Raise click.UsageError for the first option that a study, computed already, has no use for."""
    refuse_unused("the store of a study", *(name for name in context.params if name not in BESIDE_A_STORE))


def of_study(store: str, shown: str, progress: Progress) -> Report:
    """The report on a finished study."""
    from ridgeback.compare.report.several.study_report import study_report

    return study_report(store, command=shown, warned=say, progress=progress)


def of_folder(folder: str, output: str, shown: str) -> Report:
    """The index of a folder of reports."""
    from ridgeback.compare.report.several.index import index_report

    return index_report(folder, beside="" if output == STDOUT else Path(output).parent, command=shown)


def refuse(given: Mapping[str, object], why: str) -> None:
    """Raise click.UsageError for the first option that was given and has no place here."""
    for name, value in given.items():
        if value is not None:
            raise click.UsageError(f"{name} {why}; leave it out")


def of_motion(motion: Motion, scope: Scope, shown: str, progress: Progress) -> Report:
    """The report on a simulated motion."""
    from ridgeback.compare.report.system_report import ORDER as USUAL
    from ridgeback.compare.report.system_report import TARGET, system_report

    return system_report(
        setting_of(motion),
        order=USUAL if scope.order is None else scope.order,
        orders=scope.orders,
        amplitudes=scope.amplitudes,
        target=TARGET if scope.target is None else scope.target,
        trials=scope.trials,
        timed=scope.timed,
        command=shown,
        progress=progress,
    )


def setting_of(motion: Motion) -> Setting:
    """The motion asked for; without a system the paper's, with whatever was said changed."""
    from ridgeback.compare.motion.motion import setting
    from ridgeback.compare.motion.paper_case import paper_case

    if motion.choice.made:
        chosen = entitled(motion.choice.oscillator(), motion.title)
        return setting(chosen, initial=motion.initial, duration=motion.duration, rate=motion.rate)
    paper = paper_case()
    return setting(
        entitled(paper.oscillator.with_parameters(unique(motion.choice.assignments)), motion.title),
        initial=motion.initial or paper.initial,
        duration=motion.duration or paper.duration,
        rate=motion.rate or paper.rate,
        time_unit=paper.time_unit,
    )


def entitled(oscillator: Oscillator, title: str | None) -> Oscillator:
    """The oscillator under the title that was given."""
    return oscillator if title is None else replace(oscillator, title=title)


def of_recordings(source: Source, motion: Motion, scope: Scope, shown: str, progress: Progress) -> Report:
    """The report on a recording or on several, with an oscillator's exact backbone over it when one is named."""
    refuse({"--initial": motion.initial, "--duration": motion.duration}, "belongs to a simulation, not to a recording")
    studied = {"--order": scope.order, "--orders": scope.orders, "--amplitudes": scope.amplitudes}
    refuse({**studied, "--target": scope.target}, "belongs to the study of a system, not to a recording")
    if not motion.choice.made and motion.choice.assignments:
        raise click.UsageError("--set needs a SYSTEM whose parameters it sets; name one, or leave it out")
    if not motion.choice.made:
        refuse({"--title": motion.title}, "names a SYSTEM beside the recording")
    reading = Reading(
        source.column, source.time_column, motion.rate, source.run_column, source.decimal, source.treatment
    )
    oscillator = entitled(motion.choice.oscillator(), motion.title) if motion.choice.made else None
    if len(source.files) > 1 or several(source.column) or source.run_column is not None:
        from ridgeback.compare.report.several.runs_report import runs_report

        refuse_unused("a page on several recordings", "predict_from", "trials")
        found = reading.all(source.files)
        return runs_report(
            found, band=source.band, oscillator=oscillator, timed=scope.timed, command=shown, progress=progress
        )
    from ridgeback.compare.report.recording_report import recording_report

    return recording_report(
        reading.one(source.files[0]),
        band=source.band,
        oscillator=oscillator,
        cycles=source.cycles,
        trials=scope.trials,
        timed=scope.timed,
        command=shown,
        progress=progress,
    )


def several(column: str | None) -> bool:
    """Whether more than one channel is asked for.

    >>> several("x,y"), several("all"), several("x"), several(None)
    (True, True, False, False)
    """
    return column is not None and (column == "all" or "," in column)


def as_typed(arguments: Sequence[str]) -> str:
    """The command that makes the same page again; where it is written to is no part of it.

    >>> as_typed(["report", "pendulum", "-o", "page.html", "--initial", "1,0"])
    'ridgeback report pendulum --initial 1,0'
    """
    kept: list[str] = []
    rest = iter(arguments)
    for word in rest:
        if word in ("-o", "--output", "--pdf"):
            next(rest, None)
        elif word != "--open" and not word.startswith(("--output=", "-o", "--pdf=")):
            kept.append(word)
    return " ".join(map(quoted, ["ridgeback", *kept]))


def quoted(word: str) -> str:
    """A word as a shell takes it: in double quotes where it holds a prime and nothing that a shell reads in them.

    >>> print(quoted("u'' + u**3 = 0"), quoted("page.html"), quoted("$HOME isn't"))
    "u'' + u**3 = 0" page.html '$HOME isn'"'"'t'
    """
    return f'"{word}"' if "'" in word and not set(word) & set('"$`\\!\n') else shlex.quote(word)


def publish(report: Report, output: str, style: str) -> None:
    """Write the page and say what it found, then raise PartialError for what is wrong or missing on it."""
    from ridgeback.reports.page import html_page, size_warning

    page = html_page(report)
    write_text(output, page)
    if output != STDOUT:
        write_text(STDOUT, printed(report, output, len(page.encode()), style))
    warning = size_warning(page)
    if warning is not None:
        say(warning)
    refuse_incomplete(report)


def show(output: str, pdf: str | None, *, opened: bool) -> None:
    """Print the page to a PDF, and open it, where that was asked for."""
    if pdf is not None:
        from ridgeback.console.browser import print_to_pdf

        print_to_pdf(output, pdf)
        say(f"printed {pdf}")
    if opened:
        import webbrowser

        if not webbrowser.open(Path(output).resolve().as_uri()):
            say(f"no browser could be opened; the page is {output}")
