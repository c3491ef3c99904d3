"""A pool of processes that ends at once when its user is interrupted, without a trace of its own."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context


@contextmanager
def processes(workers: int) -> Iterator[Executor | None]:
    """Yield an executor of so many processes; None for one worker, which is the caller itself.

    They are started anew (``spawn``) and leave an interrupt from the keyboard to the caller.  When the caller is left
    by an error or an interrupt, what waits is dropped and what runs is ended.

    >>> with processes(1) as executor:
    ...     executor is None
    True
    """
    if workers == 1:
        yield None
        return
    others = set(active_children())
    executor = ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=_deaf)
    try:
        yield executor
    except BaseException:
        executor.shutdown(wait=False, cancel_futures=True)
        for child in set(active_children()) - others:
            child.terminate()
        raise
    finally:
        executor.shutdown(wait=True, cancel_futures=True)


def _deaf() -> None:
    """A terminal sends Ctrl-C to every process of the group; only the caller answers it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
