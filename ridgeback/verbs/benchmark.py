"""``ridgeback benchmark``: every way to omega0(t) of one motion, with its error and its cost."""

from __future__ import annotations

import click

from ridgeback.answers.benchmark_table import benchmark_text
from ridgeback.common.progress import showing
from ridgeback.console.failure import PartialError
from ridgeback.console.output import write_bytes, write_text
from ridgeback.console.verb import Verb
from ridgeback.options.arguments import ORDERS, PAIR, POSITIVE
from ridgeback.options.plot import plot_option
from ridgeback.options.shared import format_option, output_option
from ridgeback.options.system import Choice, choosing


@click.command("benchmark", cls=Verb, short_help="Error and cost of every way to omega0(t) of one motion.")
@choosing
@click.option("--initial", type=PAIR, default=None, metavar="U,V", help="State at time 0.  Default: the catalogue's.")
@click.option("--duration", type=POSITIVE, default=None, metavar="T", help="Default: 40 natural periods.")
@click.option("--rate", type=POSITIVE, default=None, metavar="R", help="Default: 32 samples in each natural period.")
@click.option(
    "--orders",
    type=ORDERS,
    default="2,4,6,8,10,12,14,16,18,20,24,28,32,36,40",
    show_default=True,
    metavar="N,N,...",
    help="Orders of the expansion.",
)
@format_option("text", "json", "csv", default="text")
@plot_option("error against cost of every contender")
@output_option
def command(
    *,
    choice: Choice,
    initial: tuple[float, float] | None,
    duration: float | None,
    rate: float | None,
    orders: tuple[int, ...],
    style: str,
    plot: str | None,
    output: str,
) -> None:
    """Hold expansions, the paper's series model and estimates of SYSTEM's motion on one scale.

    Expansions run as their generated code, at the amplitude of the energy and of the averaged action; every method is
    judged on one support, against the cycle frequency of the integrated solution, and timed in the same run.

    \b
    ridgeback benchmark pendulum --set mu=0.01 --set k=12.566370614359172 --initial 2.984513,0 --duration 20 --rate 64
    ridgeback benchmark van-der-pol --initial 0.5,0 --format json
    ridgeback benchmark --equation "u'' + 2*mu*u' + c3*u'**3 + u + g*u**3 = 0" --set mu=0.01 --set c3=0.02 --set g=0.5
    """
    from ridgeback.interface.benchmark import benchmark

    with showing(True) as progress:
        found = benchmark(
            choice.oscillator(), initial=initial, duration=duration, rate=rate, orders=orders, progress=progress
        )
    if plot is not None:
        from ridgeback.reports.figures.benchmark import plot_file

        write_bytes(plot, plot_file(found, plot.rpartition(".")[2].lower()))
    write_text(output, benchmark_text(found, style))
    failed = [row for row in found.contenders if row.refused is not None and row.kind == "estimate"]
    if failed:
        raise PartialError(f"{len(failed)} of the estimates give nothing here; the output says why")
