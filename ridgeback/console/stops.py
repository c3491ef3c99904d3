"""Requests to stop, from the keyboard, a shell or a batch system, and the one answer to all of them."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread

STOPS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""Signals by which a user, a shell or a batch system asks a run to stop."""


@contextmanager
def stoppable() -> Iterator[None]:
    """Answer SIGTERM and SIGHUP like Ctrl-C: KeyboardInterrupt in the main thread.

    A signal that is ignored, as ``nohup`` has it, stays so, as does an answer that somebody else has given.

    >>> with stoppable():
    ...     signal.getsignal(signal.SIGTERM) is signal.default_int_handler
    True
    """
    if current_thread() is not main_thread():
        yield
        return
    plain = [stop for stop in STOPS if signal.getsignal(stop) is signal.SIG_DFL]
    for stop in plain:
        signal.signal(stop, signal.default_int_handler)
    try:
        yield
    finally:
        for stop in plain:
            signal.signal(stop, signal.SIG_DFL)
