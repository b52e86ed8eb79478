# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Folders of Zarr groups, which appear complete or not at all, and replace no others."""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import re
import shutil
import time
from collections.abc import Iterator

from ._types import Path
from ._ugrid import MAKER

_numbers = itertools.count()

# All files that a group may have.
_MESH = "areas|duplicates|faces|ghost_faces|mesh|neighbors|node_lat|node_lon|sites"
_WEIGHTS = "S|row|col|row_begin|chunk_row|(area|frac|mask|xc|yc)_[ab]|(src|dst)_grid_dims"
_ARRAYS = f"{_MESH}|{_WEIGHTS}"
_KNOWN = re.compile(rf"zarr\.json|({_ARRAYS})(/(zarr\.json|c(\.\d+)*))?")


def require_replaceable(path: Path) -> str:
    """The folder that will be written, without links. Raises OSError if it must not be replaced."""
    name = os.fsdecode(path).rstrip("/") or "/"
    target = os.path.realpath(name)

    def refuse(why: str) -> OSError:
        return FileExistsError(errno.EEXIST, f"{why}; the folder is not replaced", name)

    with _told(name):
        os.stat(os.path.join(os.path.dirname(target), "."))
        if not os.path.lexists(target):
            return target
        if not os.path.isdir(target):
            raise NotADirectoryError(errno.ENOTDIR, "a file, where a folder is to be made", name)
        inside = list(_names_in(target))
    for found, is_link in inside:
        if is_link or not _KNOWN.fullmatch(found):
            raise refuse(f"'{found}' in it is not ours")
    if inside and not _is_ours(target):
        raise refuse("it was not made by rondel")
    return target


def _names_in(folder: str, prefix: str = "") -> Iterator[tuple[str, bool]]:
    """All that is in a folder, by its name there, and whether it is a symbolic link."""
    with os.scandir(folder) as entries:
        for entry in sorted(entries, key=lambda entry: entry.name):
            yield prefix + entry.name, entry.is_symlink()
            if entry.is_dir(follow_symlinks=False):
                yield from _names_in(entry.path, f"{prefix}{entry.name}/")


def _is_ours(folder: str) -> bool:
    try:
        with open(os.path.join(folder, "zarr.json"), encoding="utf-8") as file:
            return MAKER in file.read()
    except (OSError, UnicodeDecodeError):
        return False


@contextlib.contextmanager
def _told(path: str) -> Iterator[None]:
    """Lets errors of the system name the path that the caller gave."""
    try:
        yield
    except OSError as error:
        if error.errno is None or error.filename == path:
            raise
        raise OSError(error.errno, error.strerror, path) from None


@contextlib.contextmanager
def replaced(path: Path) -> Iterator[str]:
    """A new folder, which gets its name when all is done; of what fails nothing is left."""
    name = os.fsdecode(path)
    target = require_replaceable(path)
    mode = os.stat(target).st_mode & 0o777 if os.path.isdir(target) else None
    folder = os.path.join(os.path.dirname(target), f".rondel-{os.getpid()}-py{next(_numbers)}.tmp")
    with _told(name):
        os.mkdir(folder, 0o777 if mode is None else 0o700)
        try:
            yield folder
            require_replaceable(path)
            if mode is not None:
                os.chmod(folder, mode)
            _exchange(folder, target)
        except BaseException as error:
            _remove(folder, is_busy=isinstance(error, KeyboardInterrupt))
            raise


def _exchange(folder: str, target: str) -> None:
    """Puts a folder into the place of another one, if there is one, which is removed."""
    if not os.path.isdir(target):
        os.rename(folder, target)
        return
    old = folder + "-old"
    os.rename(target, old)
    try:
        os.rename(folder, target)
    except BaseException:
        os.rename(old, target)
        raise
    shutil.rmtree(old)


def _remove(folder: str, is_busy: bool) -> None:
    """Removes a folder, into which a thread of zarr may still write a chunk if it is busy."""
    shutil.rmtree(folder, ignore_errors=True)
    for _ in range(10 if is_busy else 0):
        time.sleep(0.05)
        shutil.rmtree(folder, ignore_errors=True)
