"""A pool of processes that ends at once when its user is interrupted, or when its parent is gone."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, parent_process
from multiprocessing.connection import wait
from threading import Thread, current_thread, main_thread

from ridgeback.console.stops import STOPS


@contextmanager
def processes(workers: int) -> Iterator[Executor | None]:
    """Yield an executor of so many processes; None for one worker, which is the caller itself.

    They are started as new interpreters (``spawn``) and leave every request to stop to the caller.  When the block is
    left by an error or an interrupt, they are ended; futures must not be cancelled before, which breaks their manager.
    Each of them watches its parent and ends when that is gone, even killed.

    >>> with processes(1) as executor:
    ...     executor is None
    True
    """
    if workers == 1:
        yield None
        return
    others = set(active_children())
    executor = ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=end_with_parent)
    try:
        with _ignoring_interrupts():
            for _ in range(workers):
                executor.submit(int)  # each call starts a process
        yield executor
    except BaseException:
        for child in set(active_children()) - others:
            child.kill()
        raise
    finally:
        executor.shutdown(wait=True)


def end_with_parent() -> None:
    """Watch the parent from a thread, and end this process when it is gone."""
    Thread(target=_end_after_parent, daemon=True).start()


def _end_after_parent() -> None:
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


@contextmanager
def _ignoring_interrupts() -> Iterator[None]:
    """Ignore requests to stop for a moment: processes that start now ignore them for good, and leave the answer to us.

    A terminal sends Ctrl-C, and a batch system SIGTERM, to every process of the group.  Only the main thread may say
    what is done about a signal.
    """
    if current_thread() is not main_thread():
        yield
        return
    before = {stop: signal.signal(stop, signal.SIG_IGN) for stop in STOPS}
    try:
        yield
    finally:
        for stop, answer in before.items():
            signal.signal(stop, answer)
