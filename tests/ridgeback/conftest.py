"""Running the command line inside the test's own process."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import pytest

from ridgeback.cli import main


class Result(NamedTuple):
    """Exit code, standard output, standard error."""

    code: int
    out: str
    err: str


Ridgeback = Callable[..., Result]


@pytest.fixture
def ridgeback(capsys: pytest.CaptureFixture[str]) -> Ridgeback:
    """The command line as a function of its arguments."""

    def run(*arguments: str) -> Result:
        capsys.readouterr()
        code = main(arguments)
        captured = capsys.readouterr()
        return Result(code, captured.out, captured.err)

    return run
