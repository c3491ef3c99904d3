"""A pool of processes that ends at once when its user is interrupted, without a trace of its own."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context
from threading import current_thread, main_thread


@contextmanager
def processes(workers: int) -> Iterator[Executor | None]:
    """Yield an executor of so many processes; None for one worker, which is the caller itself.

    They are started anew (``spawn``) and leave an interrupt from the keyboard to the caller.  When the block is left
    by an error or an interrupt, they are ended; futures must not be cancelled before, which their manager takes ill.

    >>> with processes(1) as executor:
    ...     executor is None
    True
    """
    if workers == 1:
        yield None
        return
    others = set(active_children())
    executor = ProcessPoolExecutor(workers, mp_context=get_context("spawn"))
    try:
        with _deaf():
            for _ in range(workers):
                executor.submit(int)  # each call starts a process
        yield executor
    except BaseException:
        for child in set(active_children()) - others:
            child.terminate()
        raise
    finally:
        executor.shutdown(wait=True)


@contextmanager
def _deaf() -> Iterator[None]:
    """Ignore Ctrl-C for a moment: processes that start now ignore it for good, and leave the answer to the caller.

    A terminal sends it to every process of the group.  Only the main thread may say what is done about a signal.
    """
    if current_thread() is not main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
