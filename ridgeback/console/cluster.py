"""Workers of a dask scheduler as an executor: the same blocks, computed elsewhere."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib.metadata import version
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.show.optional import MissingLibraryError, optional

PATIENCE = 120.0
"""Seconds to wait for the scheduler, and for its first worker."""


@contextmanager
def cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """An executor on the workers of a scheduler, and how many threads they have.

    Raises InputError where dask is not installed or a worker has another version of ridgeback, OSError where the
    scheduler or its workers cannot be reached.
    """
    with _client(address) as client:
        _check_workers(client, address)
        yield client.get_executor(pure=False, retries=2), max(1, sum(client.nthreads().values()))


@contextmanager
def _client(address: str) -> Iterator[Any]:
    try:
        library = optional("distributed", "--scheduler")
    except MissingLibraryError:
        raise InputError('--scheduler needs dask; install it: pip install "ridgeback[distributed]"') from None
    try:
        client = library.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise OSError(None, f"no scheduler answers ({error}); start one: dask scheduler", address) from None
    try:
        yield client
    finally:
        client.close()


def _check_workers(client: Any, address: str) -> None:
    """Wait for a worker, and refuse those that would compute something else."""
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except OSError:
        raise OSError(None, f"the scheduler has no worker; start one: dask worker {address}", address) from None
    mine = own_version()
    for worker, other in client.run(own_version).items():
        if other != mine:
            raise InputError(f"worker {worker} has ridgeback {other}, this is {mine}; install the same on both")


def own_version() -> str:
    """The version of ridgeback where this runs; linear algebra is kept to one thread there from now on."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    return version("ridgeback")
