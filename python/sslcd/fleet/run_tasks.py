# SPDX-License-Identifier: BSD-3-Clause
"""A stage: tasks on the workers, few at a time, so that neither the scheduler nor this process holds
more than it must."""

import uuid
from typing import Any, Callable, Dict, Iterable, Iterator, List, Optional, Tuple

from distributed import Client, Future, as_completed
from distributed.scheduler import KilledWorker

from ..errors import NoSolutionError, OutputError
from .report import Progress
from .tasks import Record

#: For each thread of the workers: tasks that are sent at a time. A worker has the next one at hand.
TASKS_PER_THREAD = 3

#: Names of what a task is about, for its record where the task gives none; its function; arguments.
Task = Tuple[Record, Callable[..., Record], Tuple[Any, ...]]


def run_tasks(
    client: Client, tasks: Iterable[Optional[Task]], progress: Progress
) -> Iterator[Record]:
    """The records of tasks in the order in which they end. The tasks are asked for when they can be
    sent; None is one that is not necessary.

    A task whose worker dies runs again on another one; one that has ended several workers has a
    record with an error. What is done stays when this raises:

    Raises:
        NoSolutionError: the scheduler is lost.
        OutputError: a task cannot write its output; all others would fail, too.
    """
    waiting = iter(tasks)
    about: Dict[Future, Record] = {}
    running = as_completed(loop=client.loop)
    threads = max(1, sum(client.nthreads().values()))

    def fill() -> None:
        while len(about) < TASKS_PER_THREAD * threads:
            task = next(waiting, _END)
            if task is _END:
                return
            if task is None:
                progress.skipped()
                continue
            names, function, arguments = task
            # builds of several processes may share the scheduler
            key = f"{function.__name__}-{uuid.uuid4().hex}"
            future = client.submit(function, *arguments, key=key, pure=False)
            about[future] = names
            running.add(future)

    try:
        fill()
        while about:
            future = next(running)
            record = _record_of(future, about.pop(future))
            progress.ended(record)
            if record["fatal"]:
                raise OutputError(
                    f"{record['error']}: an output cannot be written, so the build has ended; make "
                    "room or name another folder. What is done is kept, and the same command goes on"
                )
            yield record
            fill()
    finally:
        client.cancel(list(about))
        progress.close()


_END: Any = object()


def _record_of(future: Future, names: Record) -> Record:
    if future.cancelled():
        raise NoSolutionError(
            "the scheduler, or the connection to it, was lost; what is done is kept, and the same "
            "command goes on"
        )
    failure = future.exception()
    if failure is None:
        return future.result()
    error = f"{type(failure).__name__}: {failure}"
    if isinstance(failure, KilledWorker):
        error = (
            "the processes that worked on it were ended, each time: by the system for their memory, "
            "by hand, or by a crash; see the logs of the workers"
        )
    return {**names, "error": error, "fatal": False, "reused": False}


def in_order(records: Iterable[Record], name: str) -> List[Record]:
    """Records by their names, since the order in which tasks end is left to chance."""
    return sorted(records, key=lambda record: record[name])
