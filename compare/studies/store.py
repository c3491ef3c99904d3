"""Where finished blocks are kept: an SQLite file that survives the end of its process at any moment.

Every block is one row with its inputs, its outcomes and a digest of both, written in a transaction of its own to a
write-ahead log.  Several processes may work on one store; none ever waits for another's computation.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any, Final

from ridgeback.common.errors import InputError
from ridgeback.common.files import check_regular, naming
from ridgeback.compare.studies.plan import Plan, differences, plan_from
from ridgeback.compare.studies.tasks import Outcome, Task, inputs_of, key_of, outcomes_from, outcomes_text

FORMAT: Final = "ridgeback study"
VERSION: Final = 1
MAGIC: Final = b"SQLite format 3\x00"
PATIENCE: Final = 60.0
"""Seconds to wait while another process writes."""
SCHEMA: Final = (
    "CREATE TABLE IF NOT EXISTS about (name TEXT PRIMARY KEY, value TEXT NOT NULL)",
    "CREATE TABLE IF NOT EXISTS blocks (key TEXT PRIMARY KEY, inputs TEXT NOT NULL, outcomes TEXT NOT NULL, "
    "digest TEXT NOT NULL) WITHOUT ROWID",
)

Warned = Callable[[str], None]
"""Told what was mended."""


class Store:
    """The blocks of one study; made by :func:`opened`."""

    def __init__(self, path: Path, connection: sqlite3.Connection) -> None:
        self.path, self.connection = path, connection

    def about(self) -> dict[str, str]:
        """What the store says of itself: format, version, the program that made it, the plan."""
        return dict(self.connection.execute("SELECT name, value FROM about"))

    def plan(self) -> Plan:
        """The plan whose blocks are kept."""
        return plan_from(json.loads(self.about()["plan"]))

    def has(self, task: Task) -> bool:
        """Whether a block is there; whether it is whole is seen when it is read."""
        row = self.connection.execute("SELECT 1 FROM blocks WHERE key = ?", (key_of(task),)).fetchone()
        return row is not None

    def read(self, task: Task) -> tuple[Outcome, ...] | None:
        """The outcomes of a block, None when it is not there or damaged."""
        key, inputs = key_of(task), inputs_of(task)
        try:
            row = self.connection.execute(
                "SELECT inputs, outcomes, digest FROM blocks WHERE key = ?", (key,)
            ).fetchone()
        except (sqlite3.DatabaseError, UnicodeDecodeError):
            return None
        if row is None or row[0] != inputs or row[2] != digest(key, row[0], row[1]):
            return None
        with suppress(ValueError):
            outcomes = outcomes_from(row[1])
            if len(outcomes) == len(task.cells()):
                return outcomes
        return None

    def write(self, task: Task, outcomes: Sequence[Outcome]) -> None:
        """Keep a block, in the place of a damaged one."""
        key, inputs, text = key_of(task), inputs_of(task), outcomes_text(outcomes)
        with naming(self.path), translated(self.path), self.connection:
            self.connection.execute(
                "INSERT OR REPLACE INTO blocks VALUES (?, ?, ?, ?)", (key, inputs, text, digest(key, inputs, text))
            )

    def close(self) -> None:
        """Fold the log into the file and close it."""
        with suppress(sqlite3.DatabaseError):
            self.connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        self.connection.close()


def digest(key: str, inputs: str, outcomes: str) -> str:
    """What proves a row whole."""
    return hashlib.sha256("\n".join((key, inputs, outcomes)).encode()).hexdigest()


@contextmanager
def opened(path: Path, plan: Plan, program: str, *, warned: Warned) -> Iterator[Store]:
    """A store for this plan, new or taken up again.

    Parameters
    ----------
    path : Path
        The file; it is made where there is none.
    plan : Plan
        The study.
    program : str
        Name and version of the program, which is a setting like the others.
    warned : callable
        Told of damage that was mended.

    Raises
    ------
    InputError
        For a file that is no store, and for a store of another study, with what differs.
    OSError
        For a file that cannot be used.
    """
    about = {"format": FORMAT, "version": str(VERSION), "program": program, "plan": json.dumps(plan.to_dict())}
    rescue(path, warned)
    with naming(path), translated(path), closing(connected(path)) as connection:
        with connection:
            connection.execute("BEGIN IMMEDIATE")
            for statement in SCHEMA:
                connection.execute(statement)
            connection.executemany("INSERT OR IGNORE INTO about VALUES (?, ?)", about.items())
        store = Store(path, connection)
        check(store, about)
        try:
            yield store
        finally:
            store.close()


@contextmanager
def existing(path: Path) -> Iterator[Store]:
    """A store that is there already, as it is.  Raises InputError for what is none."""
    if not path.exists():
        raise InputError(f"{path} is not there; run its study first, or give the path of its store")
    check_magic(path)
    with naming(path), translated(path), closing(connected(path)) as connection:
        store = Store(path, connection)
        try:
            about = store.about()
        except sqlite3.DatabaseError:
            about = {}
        if about.get("format") != FORMAT or about.get("version") != str(VERSION):
            raise InputError(f"{path} is no store of studies of this version ({FORMAT}, version {VERSION})")
        yield store


def connected(path: Path) -> sqlite3.Connection:
    """An open database, with a write-ahead log, used from the thread that opened it."""
    connection = sqlite3.connect(path, timeout=PATIENCE, isolation_level="IMMEDIATE")
    connection.execute("PRAGMA journal_mode=WAL")
    connection.execute("PRAGMA synchronous=NORMAL")
    return connection


def check(store: Store, about: Mapping[str, str]) -> None:
    """Raise InputError unless the store is of this study."""
    found = store.about()
    if found.get("format") != FORMAT or found.get("version") != str(VERSION):
        raise InputError(f"{store.path} is no store of studies of this version; name another with --store")
    changed = differences(json.loads(found["plan"]), json.loads(about["plan"]))
    if found["program"] != about["program"]:
        changed.append(f"program was {found['program']}, is {about['program']}")
    if changed:
        raise InputError(
            f"{store.path} holds another study: {'; '.join(changed)}; name another --store, or remove this one"
        )


def check_magic(path: Path) -> None:
    """Raise InputError for a file that is no SQLite database."""
    check_regular(path)
    with path.open("rb") as file:
        if file.read(len(MAGIC)) not in (MAGIC, b""):
            raise InputError(f"{path} is no store of a study; name another file with --store")


@contextmanager
def translated(path: Path) -> Iterator[None]:
    """Turn SQLite's errors into those of files."""
    try:
        yield
    except sqlite3.Error as error:
        raise OSError(
            None, f"the store cannot be used ({error}); free space or mend its permissions", str(path)
        ) from None


def rescue(path: Path, warned: Warned) -> None:
    """Copy what can still be read of a damaged store to a new one, and put the damaged file aside.

    Raises InputError for a file that is no store, or of which nothing can be read.
    """
    if not path.exists() or path.stat().st_size == 0:
        return
    check_magic(path)
    if sound(path):
        return
    aside = path.with_name(path.name + ".damaged")
    about, rows = salvaged(path)
    if "plan" not in about:
        raise InputError(f"{path} is damaged, its plan cannot be read; remove it and start again")
    fresh = path.with_name(path.name + ".rescued")
    fresh.unlink(missing_ok=True)
    with closing(sqlite3.connect(fresh)) as new, new:
        for statement in SCHEMA:
            new.execute(statement)
        new.executemany("INSERT INTO about VALUES (?, ?)", about.items())
        new.executemany("INSERT OR IGNORE INTO blocks VALUES (?, ?, ?, ?)", rows)
    path.replace(aside)
    for tail in ("-wal", "-shm"):
        path.with_name(path.name + tail).unlink(missing_ok=True)
    fresh.replace(path)
    warned(f"{path} is damaged: {len(rows)} blocks were saved, the others are computed again; the old file is {aside}")


def sound(path: Path) -> bool:
    """Whether SQLite finds the file's structure whole."""
    with suppress(sqlite3.DatabaseError), closing(connected(path)) as connection:
        found: Any = connection.execute("PRAGMA quick_check(1)").fetchone()
        return found is not None and found[0] == "ok"
    return False


def salvaged(path: Path) -> tuple[dict[str, str], list[tuple[str, str, str, str]]]:
    """What can be read of a damaged store: what it says of itself, and the rows that are whole."""
    about: dict[str, str] = {}
    rows: list[tuple[str, str, str, str]] = []
    for order in ("ASC", "DESC"):
        with suppress(sqlite3.DatabaseError, UnicodeDecodeError), closing(connected(path)) as connection:
            about |= dict(connection.execute("SELECT name, value FROM about"))
            for row in connection.execute(f"SELECT key, inputs, outcomes, digest FROM blocks ORDER BY key {order}"):  # noqa: S608 - one of two words
                if all(isinstance(value, str) for value in row) and row[3] == digest(*row[:3]):
                    rows.append(row)
    return about, rows
