# SPDX-License-Identifier: BSD-3-Clause
"""Outputs that are named by what they are made from: whole or missing, and never made twice."""

import contextlib
import errno
import hashlib
import json
import os
import shutil
import tempfile
import uuid
from typing import Any, Dict, Iterator, Optional

from distributed import get_worker

from ..errors import OutputError

#: Folders of a build within the folder of its outputs.
FOLDERS = ("drives", "index", "pairs", "sites")


def digest(value: Any) -> str:
    """A name of 32 letters for a value of lists, dicts, texts and numbers."""
    text = json.dumps(value, sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def place(out: str, folder: str, name: str) -> str:
    """The path of an output. Outputs are spread over 256 folders, since file systems are slow with
    many files in one."""
    return os.path.join(out, folder, name[:2], name)


def disk_is_full(problem: BaseException) -> bool:
    """Whether a disk of the worker has no room, or is read-only."""
    return isinstance(problem, OSError) and problem.errno in (
        errno.ENOSPC,
        errno.EDQUOT,
        errno.EROFS,
    )


def cannot_write(problem: BaseException) -> bool:
    """The same, or an output that may not be written."""
    denied = isinstance(problem, OSError) and problem.errno == errno.EACCES
    return denied or disk_is_full(problem)


def publish(file: str, path: str) -> None:
    """Copies a finished file to its final name: readers see all of it or nothing, and a process that
    is killed leaves only a temporary name. Raises OSError, and OutputError for a map whose log has
    not been written into it."""
    _check_log(file)
    folder = os.path.dirname(path)
    os.makedirs(folder, exist_ok=True)
    temporary = f"{path}.tmp-{uuid.uuid4().hex[:8]}"
    try:
        with open(file, "rb") as source, open(temporary, "wb") as target:
            shutil.copyfileobj(source, target)
            target.flush()
            os.fsync(target.fileno())
        os.replace(temporary, path)
    finally:
        with contextlib.suppress(OSError):
            os.remove(temporary)


def _check_log(file: str) -> None:
    """SQLite does not tell where closing a map could not write its log into it, e.g. on a full disk:
    the file alone would lack the last sessions. Raises OutputError."""
    log = f"{file}-wal"
    if os.path.exists(log) and os.path.getsize(log) > 0:
        raise OutputError(
            f"{file}: its log could not be written into it; make room on the worker's local disk"
        )


@contextlib.contextmanager
def writing(out: str) -> Iterator[None]:
    """What writes the folder of the outputs: OSError becomes OutputError, with a way out."""
    try:
        yield
    except OutputError:  # which is an OSError
        raise
    except OSError as problem:
        raise OutputError(
            f"{out}: cannot be written: {problem}; make room, or name a folder that all workers can "
            "write to"
        ) from None


def publish_text(text: str, path: str) -> None:
    """The same for a text."""
    with scratch() as folder:
        file = os.path.join(folder, "text")
        with open(file, "w", encoding="utf-8") as target:
            target.write(text)
        publish(file, path)


def read_json(path: str) -> Dict[str, Any]:
    """The content of a published text."""
    with open(path, encoding="utf-8") as file:
        return json.load(file)


@contextlib.contextmanager
def scratch() -> Iterator[str]:
    """A folder on the local disk of the worker, gone afterwards. SQLite's log needs a local disk. Dask
    removes what a killed worker leaves there."""
    with tempfile.TemporaryDirectory(prefix="sslcd-fleet-", dir=_local_folder()) as folder:
        yield folder


def _local_folder() -> Optional[str]:
    """That of the worker; None: this is no worker."""
    try:
        return get_worker().local_directory
    except ValueError:
        return None


@contextlib.contextmanager
def local_copy(path: str) -> Iterator[str]:
    """A published map on the local disk."""
    with scratch() as folder:
        yield shutil.copyfile(path, os.path.join(folder, "map.db"))
