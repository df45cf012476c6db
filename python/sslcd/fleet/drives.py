# SPDX-License-Identifier: BSD-3-Clause
"""Drives by path or URL: which there are, what their files are, and a local copy."""

import contextlib
import hashlib
import os
import re
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Sequence, Tuple

import fsspec

from ..errors import BadInputError, UsageError
from .content import digest, disk_is_full, scratch

_IMAGES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff")
_NOT_NEEDED = (*_IMAGES, ".webp", ".bin", ".pcd", ".db", ".bag", ".mcap")
#: Files of stamps, in the folder of a drive. With another one the names of images just count, too.
_STAMPS = ("times.txt", *(f"{each}/timestamps.txt" for each in ("oxts", "image_00", "image_02")))
#: Of a KITTI raw drive, in the folder of its day: its loader looks beside the drive, too.
_BESIDE = ("calib_cam_to_cam.txt", "calib_imu_to_velo.txt", "calib_velo_to_cam.txt")
_NAME = re.compile(r"^([^/\\:=?*]+)=(.+)$")


@dataclass(frozen=True)
class Drive:
    """A recorded drive: a dataset folder, docs/formats.md."""

    name: str  #: of its session in the map of its site
    url: str  #: path, or a URL that fsspec knows


def find_drives(given: Sequence[str], storage: Dict[str, Any]) -> List[Drive]:
    """The drives of arguments in order of their names.

    Args:
        given: folders, as paths or URLs; with `*` and `?`: all folders that fit; NAME=FOLDER gives a
            drive another name than that of its folder; @FILE: a file with one of these per line.
        storage: fsspec's storage options.

    Raises:
        UsageError: two drives of one name, nothing that fits, an unknown kind of URL.
        BadInputError: a folder that is not there, or that may not be read.
    """
    drives: List[Drive] = []
    for text in _lines_of(given):
        named = _NAME.match(text)
        url = named[2] if named else text
        for found in _folders(url, storage):
            drives.append(Drive(named[1] if named else _last_part(found), found))
    by_name: Dict[str, Drive] = {}
    for drive in drives:
        other = by_name.setdefault(drive.name, drive)
        if other is not drive:
            raise UsageError(
                f"two drives have the name '{drive.name}': {other.url} and {drive.url}; give one of "
                f"them another name, as in {drive.name}-2={drive.url}"
            )
    if not drives:
        raise UsageError("no drive is given; name dataset folders, or a pattern such as 'drives/*'")
    return sorted(drives, key=lambda drive: drive.name)


def _lines_of(given: Sequence[str]) -> Iterator[str]:
    for text in given:
        if not text.startswith("@"):
            yield text
            continue
        try:
            with open(text[1:], encoding="utf-8") as file:
                yield from (line.strip() for line in file if line.strip() and line[0] != "#")
        except (OSError, UnicodeDecodeError) as problem:
            raise BadInputError(
                f"{text[1:]}: the list of drives cannot be read: {problem}"
            ) from None


def _last_part(url: str) -> str:
    return url.rstrip("/").rsplit("/", 1)[-1]


def open_folder(url: str, storage: Dict[str, Any]) -> Tuple[Any, str]:
    """The file system of a URL, and the path in it. Raises UsageError if there is no such kind."""
    try:
        return fsspec.core.url_to_fs(url, **storage)
    except (ValueError, ImportError) as problem:  # unknown protocol, or its package is missing
        raise UsageError(f"{url}: {problem}") from None
    except Exception as problem:  # of the file system's own kind
        raise unreadable(url, problem) from None


def unreadable(url: str, problem: BaseException) -> BadInputError:
    """What to do about a URL that cannot be read. File systems have exceptions of their own."""
    return BadInputError(
        f"{url}: cannot be read: {type(problem).__name__}: {problem}; check the name, and the "
        "credentials of this storage on all workers (for s3 AWS_PROFILE or AWS_ACCESS_KEY_ID; "
        "--storage KEY=VALUE hands an option to fsspec)"
    )


def _folders(url: str, storage: Dict[str, Any]) -> List[str]:
    fs, path = open_folder(url, storage)
    try:
        if any(letter in path for letter in "*?"):
            found = [each for each in sorted(fs.glob(path)) if fs.isdir(each)]
            if not found:
                raise UsageError(f"{url}: no folder fits; quote the pattern, and check its place")
        elif fs.info(path)["type"] == "directory":  # isdir() is false for what may not be read
            found = [path]
        else:
            raise BadInputError(f"{url}: is a file; name the folder of a dataset")
    except (BadInputError, UsageError):
        raise
    except FileNotFoundError:
        raise BadInputError(f"{url}: no such folder; name the folder of a dataset") from None
    except Exception as problem:
        raise unreadable(url, problem) from None
    return [each if is_local(fs) else fs.unstrip_protocol(each) for each in found]


def is_local(fs: Any) -> bool:
    """Whether a file system is that of the machine."""
    protocol = fs.protocol
    return "file" in ((protocol,) if isinstance(protocol, str) else protocol)


def _files(fs: Any, path: str) -> Tuple[List[str], List[str]]:
    """The files of a drive that are read. The images whose names are: these may be stamps, where no
    file has the stamps."""
    found = sorted(_local_files(path) if is_local(fs) else fs.find(path))
    files = [each for each in found if not each.lower().endswith(_NOT_NEEDED)]
    if any(_relative(each, path) in _STAMPS for each in files):
        return files, []
    return files, [each for each in found if each.lower().endswith(_IMAGES)]


def _local_files(path: str) -> Iterator[str]:
    """Links to folders are followed, as the loader does; links to nothing are no files, but for
    images, whose names count. fsspec's find() takes links to folders for files."""
    seen = set()
    for folder, inner, names in os.walk(path, followlinks=True):
        real = os.path.realpath(folder)
        if real in seen:  # links may lead in a circle
            inner.clear()
            continue
        seen.add(real)
        inner.sort()
        files = (os.path.join(folder, name) for name in names)
        yield from (
            each for each in files if each.lower().endswith(_IMAGES) or os.path.isfile(each)
        )


def _beside(fs: Any, path: str) -> List[str]:
    """The files in the folder above a drive that its loader reads."""
    above = os.path.dirname(os.path.realpath(path) if is_local(fs) else path.rstrip("/"))
    return [each for name in _BESIDE if fs.isfile(each := f"{above}/{name}")]


def _relative(file: str, path: str) -> str:
    return file[len(path.rstrip("/")) + 1 :]


def content_of(drive: Drive, storage: Dict[str, Any]) -> str:
    """A name for the content of a drive's files: a hash of it where they are on a disk, otherwise of
    what the storage tells about it (size and checksum or time), so that nothing is downloaded. Of
    images only the names count. Raises BadInputError."""
    fs, path = open_folder(drive.url, storage)
    try:
        files, images = _files(fs, path)
        if not files:
            raise BadInputError(f"{drive.url}: the folder has no files")
        tell = _sha256 if is_local(fs) else lambda file: str(fs.checksum(file))
        told = [[_relative(file, path), tell(file)] for file in files]
        told += [[f"../{_last_part(file)}", tell(file)] for file in _beside(fs, path)]
        return digest(told + [[_relative(image, path)] for image in images])
    except BadInputError:
        raise
    except Exception as problem:
        raise unreadable(drive.url, problem) from None


def _sha256(file: str) -> str:
    made = hashlib.sha256()
    with open(file, "rb") as opened:
        for block in iter(lambda: opened.read(1 << 20), b""):
            made.update(block)
    return made.hexdigest()


@contextlib.contextmanager
def local_folder(drive: Drive, storage: Dict[str, Any]) -> Iterator[str]:
    """The folder of a drive on this machine: itself, or a copy with empty images."""
    fs, path = open_folder(drive.url, storage)
    if is_local(fs):
        yield path
        return
    with scratch() as folder:
        try:
            files, images = _files(fs, path)
            named_only = set(images)
            for file in files + images:
                target = os.path.join(folder, drive.name, *_relative(file, path).split("/"))
                os.makedirs(os.path.dirname(target), exist_ok=True)
                if file in named_only:
                    open(target, "wb").close()
                else:
                    fs.get_file(file, target)
            for file in _beside(fs, path):
                fs.get_file(file, os.path.join(folder, _last_part(file)))
        except Exception as problem:
            if disk_is_full(problem):
                raise
            raise unreadable(drive.url, problem) from None
        yield os.path.join(folder, drive.name)
