"""Requests to stop, from the keyboard, a shell or a batch system, and the one answer to all of them."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from types import FrameType

STOPS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""Signals by which a user, a shell or a batch system asks a run to stop."""


@contextmanager
def stoppable() -> Iterator[None]:
    """Answer SIGTERM and SIGHUP like Ctrl-C: KeyboardInterrupt in the main thread.

    A signal that is ignored, as ``nohup`` has it, stays so, as does an answer that somebody else has given.  A module
    written in C whose loading is stopped reports that as ImportError or SystemError: it is the stop all the same.

    >>> with stoppable():
    ...     signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    False
    """
    if current_thread() is not main_thread():
        yield
        return
    arrived = False

    def stop_now(_number: int, _frame: FrameType | None) -> None:
        nonlocal arrived
        arrived = True
        raise KeyboardInterrupt

    before = {stop: signal.getsignal(stop) for stop in STOPS}
    plain = {stop: old for stop, old in before.items() if old in (signal.SIG_DFL, signal.default_int_handler)}
    for stop in plain:
        signal.signal(stop, stop_now)
    try:
        yield
    except (ImportError, SystemError) as error:
        if arrived:
            raise KeyboardInterrupt from error
        raise
    finally:
        for stop, old in plain.items():
            signal.signal(stop, old)
