# SPDX-License-Identifier: BSD-3-Clause
"""A cluster: one on this machine, or the user's own."""

import contextlib
import importlib.util
import logging
import os
import uuid
from typing import Iterator

from distributed import Client, LocalCluster

from ..errors import UsageError
from . import tasks
from .content import writing

#: How long a scheduler, and its first worker, are waited for [s].
PATIENCE_S = 20


@contextlib.contextmanager
def local_client(workers: int, memory: str = "auto") -> Iterator[Client]:
    """A client of a cluster on this machine: `workers` processes, which a nanny starts again if they
    end. `memory`: most of each, e.g. "2GB"."""
    with contextlib.ExitStack() as stack:
        try:
            cluster = LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                memory_limit=memory,
                dashboard_address=":0",  # any port that is free
                silence_logs=logging.ERROR,
            )
        except (ValueError, OSError) as problem:
            raise UsageError(
                f"no cluster of {workers} workers with {memory} each can be started: {problem}"
            ) from None
        yield stack.enter_context(Client(stack.enter_context(cluster)))


@contextlib.contextmanager
def remote_client(address: str) -> Iterator[Client]:
    """A client of the scheduler at an address such as tcp://10.0.0.1:8786."""
    try:
        client = Client(address, timeout=PATIENCE_S)
    except (OSError, ValueError) as problem:
        raise UsageError(
            f"{address}: no scheduler answers: {problem or type(problem).__name__}; check the "
            "address, start one (`dask scheduler`), or leave --scheduler out to work on this machine"
        ) from None
    with client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE_S)
        except Exception as problem:  # TimeoutError, in releases of its own kind
            raise UsageError(
                f"{address}: the scheduler has no worker ({type(problem).__name__}); start one "
                f"(`dask worker {address}`)"
            ) from None
        yield client


def has_dashboard() -> bool:
    """Whether Dask can show its dashboard."""
    return importlib.util.find_spec("bokeh") is not None


def check_workers(client: Client, out: str) -> None:
    """Raises UsageError if a worker has another version of sslcd, or does not see the folder;
    OutputError if the folder cannot be written to."""
    try:
        versions = client.run(tasks.version)
    except Exception as problem:  # whatever an import may raise there
        raise UsageError(
            f"sslcd cannot be imported on all workers: {type(problem).__name__}: {problem}; install "
            "'sslcd[fleet]' there"
        ) from None
    own = tasks.version()
    others = {worker: version for worker, version in versions.items() if version != own}
    if others:
        raise UsageError(f"workers have another version of sslcd than {own} here: {others}")
    probe = os.path.join(out, f".probe-{uuid.uuid4().hex}")
    with writing(out), open(probe, "w", encoding="utf-8"):
        pass
    try:
        blind = [worker for worker, sees in client.run(os.path.exists, probe).items() if not sees]
    finally:
        os.remove(probe)
    if blind:
        raise UsageError(f"{out}: these workers do not see the folder: {', '.join(blind)}")
