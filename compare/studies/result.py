"""What a finished study hands over: its answers, its cells by columns, and what gave none."""

from __future__ import annotations

import math
from array import array
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ridgeback.common.show.optional import optional
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.gridded import grid_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.by_name import answers
from ridgeback.compare.studies.running import finished
from ridgeback.compare.studies.store import Store, Warned, existing
from ridgeback.compare.studies.tasks import Finished, Scalar
from ridgeback.compare.studies.tidy import columns_of, coordinates_of, rows_of


@dataclass(frozen=True)
class Failure:
    """A reason why cells have no values, and how many give it."""

    reason: str
    cells: int
    oscillator: str
    """The first of them."""


@dataclass(frozen=True)
class StudyResult:
    """A finished study; made by :func:`ridgeback.run_study`.

    Parameters
    ----------
    plan : Plan
        What was asked.
    program : str
        Name and version of what computed it.
    store : Path
        Where its cells are.
    answers : tuple of Answer
        One for each question, in the order asked.
    cells : int
        How many cells it has.
    failures : tuple of Failure
        Reasons of cells without values, the most frequent first.

    Examples
    --------
    >>> import tempfile, ridgeback
    >>> text = '''[study]
    ... ask = "error"
    ... [grid]
    ... amplitudes = [1, 4]
    ... orders = 2
    ... [[oscillator]]
    ... system = "pendulum"
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "small.toml"
    ...     _ = path.write_text(text)
    ...     found = ridgeback.run_study(path)
    >>> found.answers[0].question, found.cells, found.failed
    ('error', 2, 1)
    """

    plan: Plan
    program: str
    store: Path
    answers: tuple[Answer, ...]
    cells: int
    failures: tuple[Failure, ...]

    @property
    def failed(self) -> int:
        """Cells that have a reason and no values."""
        return sum(failure.cells for failure in self.failures)

    def rows(self) -> Iterator[dict[str, Scalar]]:
        """Every cell by column, read from the store."""
        names = [column.name for column in columns_of(self.plan)]
        with existing(self.store) as store:
            for row in rows_of(self.plan, finished(self.plan, store, warned=lambda _: None)):
                yield dict(zip(names, row, strict=True))

    def about(self) -> dict[str, Any]:
        """What stands at the head of every file of cells: program, title, questions, seed."""
        return {
            "program": self.program,
            "title": self.plan.title,
            "questions": list(self.plan.ask),
            "seed": self.plan.signal.seed,
        }

    def to_dataframe(self) -> Any:
        """The cells as a pandas DataFrame, units and meanings in its ``attrs``."""
        frame = optional("pandas", "to_dataframe").DataFrame(list(self.rows()))
        columns = columns_of(self.plan)
        frame.attrs.update(
            **self.about(),
            units={column.name: column.unit for column in columns},
            meanings={column.name: column.meaning for column in columns},
        )
        return frame

    def to_xarray(self) -> Any:
        """The cells as an xarray Dataset, with units and meanings.

        Where they are a full product, over one dimension for each coordinate that takes several values (oscillator,
        parameter, method, order, amplitude, ...); the others are scalar coordinates.  Else over one dimension ``cell``.
        """
        library, numpy = optional("xarray", "to_xarray"), optional("numpy", "to_xarray")
        columns = columns_of(self.plan)
        values: dict[str, Any] = {c.name: [] if c.kind == "text" else array("d") for c in columns}
        for row in self.rows():
            for name, value in row.items():
                values[name].append(math.nan if value is None else value)
        kinds = {"text": object, "number": float}
        found = {c.name: numpy.array(values.pop(c.name), dtype=kinds[c.kind]) for c in columns}
        told = {c.name: {"units": c.unit, "long_name": c.meaning} for c in columns}
        about = {name: str(value) for name, value in self.about().items()}
        names = [c.name for c in coordinates_of(self.plan)]
        grid = grid_of({name: found[name] for name in names})
        if grid is None:
            return library.Dataset({n: library.Variable(("cell",), x, told[n]) for n, x in found.items()}, attrs=about)
        dims = grid.dimensions
        axes = {
            name: library.Variable((name,) if name in dims else (), own if name in dims else own[0], told[name])
            for name, own in grid.axes.items()
        }
        rest = {n: library.Variable(dims, grid.shaped(x), told[n]) for n, x in found.items() if n not in names}
        return library.Dataset(rest, axes, about)


def result_of(plan: Plan, store: Store, program: str, *, warned: Warned) -> StudyResult:
    """Answer the questions from the store, whose blocks are all there."""
    counts: Counter[str] = Counter()
    first: dict[str, str] = {}
    total = 0
    for block in finished(plan, store, warned=warned):
        total += len(block.outcomes)
        for reason in (outcome for outcome in block.outcomes if isinstance(outcome, str)):
            counts[reason] += 1
            first.setdefault(reason, block.task.system.name)
    failures = tuple(Failure(reason, cells, first[reason]) for reason, cells in counts.most_common())
    return StudyResult(plan, program, store.path, tuple(answers(plan, _again(plan, store))), total, failures)


def _again(plan: Plan, store: Store) -> Callable[[], Iterator[Finished]]:
    return lambda: finished(plan, store, warned=lambda _: None)
