"""Exit codes, and the one line that a user reads when something went wrong."""

from __future__ import annotations

import sys
from enum import IntEnum

import click

from ridgeback.common.errors import InputError, one_line


class Exit(IntEnum):
    """What the exit code means; 70 is ``EX_SOFTWARE`` of sysexits.h, 130 and 141 are 128 + the signal."""

    OK = 0
    BAD_INPUT = 2
    PARTIAL = 3
    ENVIRONMENT = 4
    BUG = 70
    INTERRUPTED = 130
    BROKEN_PIPE = 141


class PartialError(Exception):
    """The output is written, but part of what was asked for is missing or not certified."""


def describe_system_error(error: OSError) -> str:
    """What the operating system refused, on which file, without its error number.

    >>> describe_system_error(FileNotFoundError(2, "No such file or directory", "run.csv"))
    "cannot use 'run.csv': No such file or directory; check the path, its permissions and the free space"
    """
    reason = error.strerror or str(error) or type(error).__name__
    if error.filename is None:
        return reason
    where = f"cannot use '{error.filename}'"
    return f"{where}: {reason}; check the path, its permissions and the free space"


def verdict(error: BaseException) -> tuple[Exit, str]:
    """The exit code and the message for anything that a verb can raise.

    >>> verdict(PartialError("2 of 5 cells have no reference"))
    (<Exit.PARTIAL: 3>, '2 of 5 cells have no reference')
    """
    match error:
        case click.ClickException():
            return Exit.BAD_INPUT, usage_message(error)
        case KeyboardInterrupt() | click.Abort():
            return Exit.INTERRUPTED, str(error) or "interrupted; nothing was written"
        case PartialError():
            return Exit.PARTIAL, str(error)
        case OSError():
            return Exit.ENVIRONMENT, describe_system_error(error)
        case OverflowError():
            return Exit.BAD_INPUT, (
                f"a number on the way is beyond the largest double, 1.8e308 ({error}); use units in which parameters, "
                "amplitudes and times are of order 1"
            )
        case MemoryError():
            return (
                Exit.ENVIRONMENT,
                "out of memory; ask for a lower order, a shorter duration or a lower rate",
            )
    if isinstance(error, InputError):
        return Exit.BAD_INPUT, str(error)
    return Exit.BUG, (
        f"unexpected {type(error).__name__}: {error}; this is a fault of ridgeback, please report it "
        "(RIDGEBACK_DEBUG=1 shows where it arose)"
    )


def usage_message(error: click.ClickException) -> str:
    """Click's own message, with the place to read more."""
    message = error.format_message().rstrip(".")
    context = getattr(error, "ctx", None)
    if context is None:
        return message
    return f"{message}; see '{context.command_path} --help'"


def say(message: str) -> None:
    """Print the one line on standard error; a closed standard error cannot be told anything."""
    try:
        sys.stderr.write(f"ridgeback: {one_line(message)}\n")
        sys.stderr.flush()
    except (OSError, ValueError, AttributeError):
        return
