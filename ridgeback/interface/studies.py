"""``ridgeback.run_study``: a study from its file, computed where one likes, kept as it goes, answered by name."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.studies.file.reading import read_plan
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.result import StudyResult, result_of
from ridgeback.compare.studies.running import WINDOW, complete
from ridgeback.compare.studies.store import Store, opened

PROGRAM = f"ridgeback {version('ridgeback')}"
STORE = ".db"
"""The ending of a store beside its study."""


def run_study(
    study: str | os.PathLike[str] | Plan,
    *,
    store: str | os.PathLike[str] | None = None,
    overrides: Mapping[str, Any] | None = None,
    executor: Executor | None = None,
    window: int = WINDOW,
    progress: Wanted = None,
    warned: Callable[[str], None] | None = None,
) -> StudyResult:
    """Run a study, or go on with it, and answer its questions.

    Parameters
    ----------
    study : path or Plan
        A TOML file, as ``ridgeback study --example paper`` prints one, or the plan that was read from one.
    store : path, optional
        Where finished cells are kept; beside the file, under its name with the ending ``.db``, by default.
    overrides : mapping, optional
        Settings in the place of the file's, by key: ``{"orders": [2, 4], "signal.trials": 12}``.
    executor : concurrent.futures.Executor, optional
        Where cells are computed: a process pool, or ``dask.distributed.Client(...).get_executor()``; here by default.
        The result does not depend on it.
    window : int
        Blocks that wait at the executor at any time; two or more for each worker.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done, and rate and remaining time in words.
    warned : callable, optional
        Told in a line of each damage of the store that was mended.

    Returns
    -------
    StudyResult
        The answers, and every cell.

    Raises
    ------
    InputError
        For a study that cannot be run, with file, line and key, and for a store of another study, with what differs.
    OSError
        For files that cannot be read or written.

    Examples
    --------
    >>> import tempfile
    >>> text = '''
    ... [study]
    ... ask = "order-needed"
    ... [grid]
    ... orders = [2, 4, 8]
    ... amplitudes = [0.5, 1.0, 2.0]
    ... tolerances = 1e-4
    ... [[oscillator]]
    ... system = "pendulum"
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "study.toml"
    ...     _ = path.write_text(text)
    ...     found = run_study(path)
    >>> [(row["order"], row["amplitude_to"]) for row in found.answers[0].rows()]
    [(2, 0.5), (4, 1.0), (None, 2.0)]
    """
    plan, place = planned(study, store, overrides or {})
    with showing(progress) as told, computing(plan, place, warned=warned) as work:
        complete(plan, work.store, executor=executor, window=window, progress=told)
        return work.result()


def planned(
    study: str | os.PathLike[str] | Plan,
    store: str | os.PathLike[str] | None,
    overrides: Mapping[str, Any],
    settings: Sequence[tuple[str, str]] = (),
) -> tuple[Plan, Path]:
    """The plan, and the path of its store; ``settings`` are overrides as text, as ``--set`` has them."""
    if isinstance(study, Plan):
        if store is None:
            raise InputError("a plan that comes from no file needs the path of a store; give store=")
        if overrides:
            raise InputError("overrides belong to a study from a file; change the plan itself")
        return study, Path(store)
    path = Path(study)
    texts = [(key, setting_text(value)) for key, value in overrides.items()]
    plan = read_plan(path, overrides=[*texts, *settings])
    return plan, path.with_suffix(STORE) if store is None else Path(store)


def setting_text(value: Any) -> str:
    """A value as the text of an override.

    >>> setting_text([2, 4]), setting_text("pade"), setting_text(("a", "b"))
    ('[2, 4]', '"pade"', '["a", "b"]')
    """
    if isinstance(value, bool | int | float):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return f"[{', '.join(setting_text(item) for item in value)}]"


@dataclass(frozen=True)
class Work:
    """An open store with the plan that it is for."""

    plan: Plan
    store: Store
    warned: Callable[[str], None]

    def result(self) -> StudyResult:
        """The answers, once all blocks are there."""
        return result_of(self.plan, self.store, PROGRAM, warned=self.warned)


@contextmanager
def computing(plan: Plan, store: Path, *, warned: Callable[[str], None] | None = None) -> Iterator[Work]:
    """Open the store of a plan for work."""
    tell = warned or (lambda _: None)
    with opened(store, plan, PROGRAM, warned=tell) as kept:
        yield Work(plan, kept, tell)
