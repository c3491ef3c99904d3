"""An option that would leave no trace in the result is refused, not passed over."""

from __future__ import annotations

import click
from click.core import ParameterSource

SAID = (ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT)


def refuse_unused(what: str, *names: str) -> None:
    """Refuse those of the running verb's options that stand on its command line though ``what`` has no use for them.

    Parameters
    ----------
    what
        The option or the choice that leaves them without a meaning.
    names
        The options, by the names of the verb's parameters.

    Raises
    ------
    click.UsageError
        When any of them was typed; a default is none.
    """
    context = click.get_current_context()
    spelled = {parameter.name: parameter.opts[0] for parameter in context.command.params}
    typed = [spelled[name] for name in names if context.get_parameter_source(name) in SAID]
    if typed:
        raise click.UsageError(f"{what} has no use for {', '.join(typed)}; leave out")
