"""Blocks in a store: whole or absent, one study only, mended where they are damaged."""

from __future__ import annotations

import dataclasses
import sqlite3
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.against import compared
from ridgeback.compare.studies.file.reading import plan_of
from ridgeback.compare.studies.measures import backbone
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.running import complete, counted, finished, tasks_of
from ridgeback.compare.studies.store import existing, opened
from ridgeback.compare.studies.tasks import Outcome, run
from ridgeback.compare.studies.tidy import rows_of

TEXT = """
[study]
ask = ["error", "order-needed"]
[grid]
orders = [2, 4]
amplitudes = [0.5, 1, 2, 3.5]
methods = ["lindstedt", "nome"]
[[oscillator]]
system = "pendulum"
[[oscillator]]
system = "helmholtz-duffing"
"""
PROGRAM = "test 1"


@pytest.fixture(autouse=True)
def small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(backbone, "CELLS", 4)


@pytest.fixture
def plan() -> Plan:
    return plan_of(TEXT)


def table(plan: Plan, path: Path, warnings: list[str] | None = None) -> list[tuple[object, ...]]:
    told = [] if warnings is None else warnings
    with opened(path, plan, PROGRAM, warned=told.append) as store:
        return list(rows_of(plan, finished(plan, store, warned=told.append)))


def test_a_store_holds_what_was_computed(plan: Plan, tmp_path: Path) -> None:
    path = tmp_path / "s.db"
    with opened(path, plan, PROGRAM, warned=pytest.fail) as store:
        assert counted(plan, store).done == 0
        complete(plan, store)
        assert counted(plan, store).done == counted(plan).cells == 32
    direct = [o for task in tasks_of(plan) for o in run(task)]
    with existing(path) as store:
        assert store.plan() == plan
        kept: list[Outcome] = [o for block in finished(plan, store, warned=pytest.fail) for o in block.outcomes]
    assert kept == direct
    assert not (tmp_path / "s.db-wal").exists()


def test_a_cell_without_value_has_its_reason_and_stops_no_other(plan: Plan, tmp_path: Path) -> None:
    with opened(tmp_path / "s.db", plan, PROGRAM, warned=pytest.fail) as store:
        complete(plan, store)
    rows = table(plan, tmp_path / "s.db")
    beyond = [row for row in rows if row[0] == "pendulum" and 3.5 in row]
    assert len(beyond) == 4
    assert all("at or beyond the separatrix" in str(row[-1]) for row in beyond)
    refused = [row for row in rows if row[0] == "helmholtz-duffing" and "nome" in row]
    assert len(refused) == 8
    assert all("elliptic" in str(row[-1]) for row in refused)
    assert sum(row[-1] == "" for row in rows) == 32 - 12


@pytest.mark.parametrize("text", ["orders = [2, 4, 8]", "orders = [2, 5]"])
def test_a_changed_setting_is_refused_with_what_differs(plan: Plan, tmp_path: Path, text: str) -> None:
    table(plan, tmp_path / "s.db")
    other = plan_of(TEXT.replace("orders = [2, 4]", text))
    with pytest.raises(InputError, match=r"orders was \[2, 4\], is \[2, ") as refusal:
        table(other, tmp_path / "s.db")
    assert "name another --store" in str(refusal.value)
    with (
        pytest.raises(InputError, match="program was test 1, is test 2"),
        opened(tmp_path / "s.db", plan, "test 2", warned=pytest.fail),
    ):
        pass
    table(dataclasses.replace(plan, title="another title"), tmp_path / "s.db")


@pytest.mark.parametrize(
    "damage",
    [
        "UPDATE blocks SET outcomes = replace(outcomes, '1', '2')",
        "UPDATE blocks SET outcomes = '[' || outcomes",
        "UPDATE blocks SET digest = ''",
        "UPDATE blocks SET inputs = '{}'",
        "DELETE FROM blocks",
    ],
)
def test_a_damaged_block_is_computed_again_with_a_warning(plan: Plan, tmp_path: Path, damage: str) -> None:
    path = tmp_path / "s.db"
    whole = table(plan, path)
    with closing(sqlite3.connect(path)) as connection, connection:
        key = connection.execute("SELECT key FROM blocks").fetchone()[0]
        connection.execute(f"{damage} WHERE key = ?", (key,))
    connection.close()
    warnings: list[str] = []
    assert table(plan, path, warnings) == whole
    assert len(warnings) == 1
    assert "computed again" in warnings[0]
    assert table(plan, path) == whole


@pytest.mark.parametrize("place", [0.2, 0.5, 0.9])
def test_a_file_with_a_broken_page_is_mended_or_refused(plan: Plan, tmp_path: Path, place: float) -> None:
    """Whatever is overwritten, the table is right or one line says what to do."""
    path = tmp_path / "s.db"
    whole = table(plan, path)
    data = bytearray(path.read_bytes())
    at = max(200, int(len(data) * place))
    data[at : at + 600] = b"\xa5" * len(data[at : at + 600])
    path.write_bytes(bytes(data))
    try:
        assert table(plan, path, []) == whole
    except InputError as refusal:
        assert "remove it and start again" in str(refusal) or "another study" in str(refusal)  # noqa: PT017


@pytest.mark.parametrize("content", [b"no database", b"SQLite format 3\x00" + bytes(100)])
def test_a_file_that_is_no_store_is_refused_and_kept(plan: Plan, tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "s.db"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"no store|damaged"):
        table(plan, path)
    assert path.read_bytes() == content


def test_what_changed_between_two_programs_is_told_cell_by_cell(
    plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The largest change first; a value that became a reason counts as infinite."""
    table(plan, tmp_path / "before.db")
    plain = backbone._values

    def moved(omega: float, reference: float, uncertainty: float) -> Outcome:
        return "lost" if omega < 0.8 else plain(omega * (2 if omega < 0.9 else 1), reference, uncertainty)

    monkeypatch.setattr(backbone, "_values", moved)
    with opened(tmp_path / "after.db", plan, "test 2", warned=pytest.fail) as store:
        complete(plan, store)
    with existing(tmp_path / "before.db") as first, existing(tmp_path / "after.db") as second:
        found = compared(first, second, warned=pytest.fail)
        known = [o for block in finished(plan, first, warned=pytest.fail) for o in block.outcomes]
    numbers = [o[0] for o in known if not isinstance(o, str)]
    assert (found.equal, found.changed) == (32 - sum(x < 0.9 for x in numbers), sum(x < 0.9 for x in numbers))
    assert found.settings[-1] == "program was test 1, is test 2"
    lost = [change for change in found.changes if change.after == "lost"]
    assert len(lost) == sum(x < 0.8 for x in numbers)
    assert {change.relative for change in found.changes if change.column == "omega"} == {0.5}
    assert all(change.before == "values" for change in lost)
    assert [change.relative for change in found.changes] == sorted((c.relative for c in found.changes), reverse=True)


def test_stores_of_different_cells_have_nothing_in_common(plan: Plan, tmp_path: Path) -> None:
    table(plan, tmp_path / "backbone.db")
    other = plan_of(TEXT.replace('"error", "order-needed"', '"decay-error"').replace('"lindstedt", "nome"', '"linear"'))
    with (
        opened(tmp_path / "decay.db", other, PROGRAM, warned=pytest.fail) as second,
        existing(tmp_path / "backbone.db") as first,
        pytest.raises(InputError, match="backbone and decay cells, which have no cell in common"),
    ):
        compared(first, second, warned=pytest.fail)


def test_two_runs_at_once_leave_one_whole_store(plan: Plan, tmp_path: Path) -> None:
    alone = table(plan, tmp_path / "alone.db")

    def run_it(_: int) -> list[tuple[object, ...]]:
        with opened(tmp_path / "s.db", plan, PROGRAM, warned=pytest.fail) as store:
            complete(plan, store)
        return table(plan, tmp_path / "s.db")

    with ThreadPoolExecutor(3) as pool:
        assert list(pool.map(run_it, range(3))) == [alone] * 3
    with closing(sqlite3.connect(tmp_path / "s.db")) as connection, connection:
        assert connection.execute("SELECT count(*) FROM blocks").fetchone()[0] == counted(plan).blocks
    connection.close()
