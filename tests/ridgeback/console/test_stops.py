"""One answer to every request to stop."""

import os
import signal

import pytest

from ridgeback.console.stops import STOPS, stoppable


@pytest.fixture(autouse=True)
def _plain():
    """The answers that a shell gives a job in the foreground, whatever the tests were started by."""
    before = {stop: signal.signal(stop, signal.SIG_DFL) for stop in STOPS}
    signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    for stop, old in before.items():
        signal.signal(stop, old)


def loading_of_a_module_in_c(stop):
    """What reaches us when a signal arrives while a module written in C is initialised."""
    try:
        os.kill(os.getpid(), stop)
    except KeyboardInterrupt:
        raise ImportError("initialization failed") from None


@pytest.mark.parametrize("stop", STOPS)
def test_a_stop_while_a_module_is_loaded_is_a_stop(stop):
    with pytest.raises(KeyboardInterrupt), stoppable():
        loading_of_a_module_in_c(stop)


def test_a_module_that_fails_by_itself_is_no_stop():
    with pytest.raises(ImportError, match="no such"), stoppable():
        raise ImportError("no such module")


def test_the_answers_of_before_are_back_afterwards():
    before = [signal.getsignal(stop) for stop in STOPS]
    with stoppable():
        assert signal.getsignal(signal.SIGHUP) not in before
    assert [signal.getsignal(stop) for stop in STOPS] == before


def test_an_ignored_signal_stays_ignored():
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with stoppable():
        os.kill(os.getpid(), signal.SIGHUP)
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
