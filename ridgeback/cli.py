"""The command line: parse, call, exit code.  No mathematics; nothing heavy is imported before a verb runs."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module

import click

from ridgeback.console.failure import Exit, say, verdict
from ridgeback.console.stops import stoppable

# The matrices here are small: threads of the linear algebra library only wait for each other (measured: a report takes
# 2.7 times the processor time with them).  It must be said before NumPy is imported; the user's own word comes first.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

VERBS = (
    *("systems", "derive", "generate", "simulate", "sample", "estimate", "identify", "study", "benchmark", "report"),
    "doctor",
)

EPILOG = """\b
Exit codes: 0 done; 2 bad input; 3 finished, but partial or not certified;
4 the environment (files, disk, memory); 70 a fault of ridgeback; 130 interrupted (Ctrl-C, SIGTERM, SIGHUP).
RIDGEBACK_DEBUG=1 shows the traceback of any failure."""


class LazyGroup(click.Group):
    """A group that imports a verb's file only when the verb, or the list of verbs, is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """The verbs, in the order in which a study uses them."""
        return list(VERBS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """The verb of this name, or None."""
        if cmd_name not in VERBS:
            return None
        command: click.Command = import_module(f"ridgeback.verbs.{cmd_name}").command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Refuse an unknown verb by naming those there are."""
        if args and args[0] not in VERBS and not args[0].startswith("-"):
            raise click.UsageError(f"no verb '{args[0]}'; there are {', '.join(VERBS)}", ctx)
        return super().resolve_command(ctx, args)


def print_version(ctx: click.Context, _parameter: click.Parameter, value: bool) -> None:
    """Print the version and stop."""
    if value and not ctx.resilient_parsing:
        import ridgeback

        click.echo(f"ridgeback {ridgeback.__version__}")
        ctx.exit()


@click.group(
    cls=LazyGroup,
    epilog=EPILOG,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=print_version,
    help="Print the version.",
)
@click.pass_context
def cli(context: click.Context) -> None:
    """Amplitude-dependent frequency of nonlinear oscillators.

    Exact perturbation expansions (the backbone) held against frequencies estimated from signals (the ridge).

    \b
    ridgeback report                                the paper's damped pendulum, as one HTML page
    ridgeback derive pendulum --order 8             an exact expansion
    ridgeback estimate run.csv --column u           the frequency of a recording over time
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


COMPLETION = "_RIDGEBACK_COMPLETE"
"""The variable by which a shell asks for completion, as click names it."""

LONGEST_INTEGER = 300_000
"""Digits that an integer may have in text: exact coefficients exceed Python's 4300, and more still read quickly."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code; every failure is one line on standard error.

    >>> main(["derive", "no-such-system"])
    2
    """
    if arguments is None and (asked := os.environ.get(COMPLETION)):
        return completion(asked)
    given = sys.argv[1:] if arguments is None else list(arguments)
    os.environ["MPLBACKEND"] = "agg"  # no window is opened, and a name that matplotlib does not know ends its import
    sys.set_int_max_str_digits(max(LONGEST_INTEGER, sys.get_int_max_str_digits()))
    try:
        # Not `cli.main`, which turns a broken pipe into exit code 1 before anybody can see it.
        with stoppable(), quiet(), cli.make_context("ridgeback", list(given), obj=tuple(given)) as context:
            cli.invoke(context)
        if sys.stdout is not None:
            sys.stdout.flush()
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except BrokenPipeError:
        abandon_stdout()
        return int(Exit.BROKEN_PIPE)
    except BaseException as error:
        return int(fail(error))
    return int(Exit.OK)


def completion(asked: str) -> int:
    """Answer a shell that completes a line, or print what it has to source."""
    from click.shell_completion import shell_complete

    return shell_complete(cli, {}, "ridgeback", COMPLETION, asked)


@contextmanager
def quiet() -> Iterator[None]:
    """No lines of NumPy about numbers beyond the largest double: what comes of them is judged where it is used."""
    with warnings.catch_warnings():
        if not os.environ.get("RIDGEBACK_DEBUG"):
            warnings.simplefilter("ignore", RuntimeWarning)
        yield


def fail(error: BaseException) -> Exit:
    """Say what went wrong; the traceback only when ``RIDGEBACK_DEBUG`` asks for it."""
    code, message = verdict(error)
    if isinstance(error, OSError):
        abandon_stdout()
    if os.environ.get("RIDGEBACK_DEBUG"):
        import traceback

        traceback.print_exception(error)
    say(message)
    return code


def abandon_stdout() -> None:
    """Send what is still buffered nowhere, so that the interpreter's exit does not complain a second time."""
    try:
        sys.stdout.flush()
    except (OSError, ValueError, AttributeError):
        with suppress(OSError, ValueError, AttributeError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
