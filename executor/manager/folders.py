"""Manages the folders into which a session unpacks applications."""

from __future__ import annotations

import errno
import shutil
import tempfile
from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.launching.reader import read_launch_files
from executor.manager.archive import ArchiveError, unpack
from executor.session.events import Unpacked
from executor.supervision.scratch import Scratch, is_in_use
from executor.universes.document import DocumentError

if TYPE_CHECKING:
    from executor.session.events import Unpack

__all__ = ["Folders"]

KEPT_FOLDERS: Final = 3
# Bytes of disk space that world and application need to start.
SPARE_BYTES: Final = 16 << 20


class Folders:
    """A folder for each application; the oldest that are not needed are removed.

    Args:
        is_alone: whether only this session uses the folder of temporary files, as in a container. If it is,
            files of earlier runs are removed when the disk is full, so that another run can start.
    """

    def __init__(self, *, is_alone: bool) -> None:
        self._is_alone = is_alone
        self._scratch = Scratch()
        self._kept: deque[Path] = deque()

    def unpack(self, effect: Unpack) -> Unpacked:
        """Unpacks one application; errors are in the result."""
        folder = self._scratch.path / str(effect.token)
        self._kept.append(folder)
        idle = [kept for kept in self._kept if str(kept) not in effect.needed]
        for oldest in idle[: max(0, min(len(idle) - 1, len(self._kept) - KEPT_FOLDERS))]:
            self._kept.remove(oldest)
            shutil.rmtree(oldest, ignore_errors=True)
        try:
            self._fill(folder, effect.archive_base64)
            return Unpacked(effect.token, str(folder), plan=read_launch_files(folder))
        except ArchiveError as error:
            return Unpacked(effect.token, error=str(error))
        except DocumentError as error:
            return Unpacked(effect.token, str(folder), problem=(error.file, error.problems[0]))

    def _fill(self, folder: Path, archive_base64: str) -> None:
        if self._is_alone and shutil.disk_usage(self._scratch.path).free < SPARE_BYTES:
            self._sweep()
        try:
            _unpack(archive_base64, folder)
        except ArchiveError as error:
            if not self._is_alone or not _is_out_of_room(error):
                raise
            shutil.rmtree(folder, ignore_errors=True)
            self._sweep()
            _unpack(archive_base64, folder)

    def _sweep(self) -> None:
        for path in Path(tempfile.gettempdir()).iterdir():
            # The world, which starts at the same time, has such a folder too; it must stay.
            if path == self._scratch.path or is_in_use(path):
                continue
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink(missing_ok=True)

    def recordings(self) -> Path:
        """Makes the folder of the recordings of this session, which its recorder may use, and returns it."""
        folder = self._scratch.path / "recordings"
        folder.mkdir()
        return folder

    def diagrams(self) -> Path:
        """Makes the folder of the diagrams of another program's tree, and returns it."""
        folder = self._scratch.path / "attached"
        folder.mkdir()
        return folder

    def remove(self) -> None:
        """Removes all folders."""
        self._scratch.remove()


def _unpack(archive_base64: str, folder: Path) -> None:
    try:
        folder.mkdir()
    except OSError as error:
        raise ArchiveError(f"it cannot be unpacked: {error}") from error
    unpack(archive_base64, folder)


def _is_out_of_room(error: ArchiveError) -> bool:
    cause = error.__cause__
    return isinstance(cause, OSError) and cause.errno in {errno.ENOSPC, errno.EDQUOT}
