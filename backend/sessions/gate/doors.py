"""The doors: `<32 random hex>/gate.sock`, a folder for each session that is starting.

Every session sees the whole volume, since Docker before 25 cannot mount a part of one. The root of the volume
may be entered but not listed (0711), so only a session that was given the name of a door can find it.
"""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import socket
from typing import TYPE_CHECKING, Final

from backend.sessions.gate.errors import GateError

if TYPE_CHECKING:
    from pathlib import Path

DOOR_NAME: Final = re.compile(r"[0-9a-f]{32}")
DOOR_SOCKET: Final = "gate.sock"
ENTER_ONLY: Final = 0o711
EVERYBODY: Final = 0o666  # any user: the folder is mounted only where it may be seen
BACKLOG: Final = 128


class Doors:
    """The folders of the open doors.

    Raises:
        GateError: the folder belongs to another user, or another gate uses it.
    """

    def __init__(self, root: Path) -> None:
        self._root = root
        try:
            root.mkdir(parents=True, exist_ok=True)
            root.chmod(ENTER_ONLY)
            self._lock = os.open(root, os.O_RDONLY | os.O_DIRECTORY)
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise GateError("gate_runs", f"Another gate uses {root}.", "One gate serves a stack.") from None
        except OSError as error:
            hint = "The volume must belong to the user that the gate runs as: remove it and start again."
            raise GateError("gate_folder", f"{root} cannot be used: {error}.", hint) from error
        # Doors do not outlive their gate: the keeper opens again those that it still needs.
        for left in root.iterdir():
            if DOOR_NAME.fullmatch(left.name):
                shutil.rmtree(left, ignore_errors=True)

    def make(self, name: str) -> socket.socket:
        """Makes a door; returns the socket that listens at it.

        Raises:
            OSError: the door exists already, or the disk space or the descriptors are exhausted.
        """
        folder = self._root / name
        folder.mkdir(mode=ENTER_ONLY)
        try:
            listener = listen_at(folder / DOOR_SOCKET)
        except OSError:
            self.remove(name)
            raise
        listener.settimeout(0)
        folder.chmod(ENTER_ONLY)  # the umask has restricted the mode
        return listener

    def remove(self, name: str) -> None:
        """Removes a door, if it exists."""
        shutil.rmtree(self._root / name, ignore_errors=True)

    def close(self) -> None:
        """Releases the folder, so that another gate can use it."""
        os.close(self._lock)


def listen_at(path: Path, mode: int = EVERYBODY) -> socket.socket:
    """Returns a socket that listens at a path; replaces an older one."""
    path.unlink(missing_ok=True)
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        listener.bind(str(path))
        path.chmod(mode)
        listener.listen(BACKLOG)
    except OSError:
        listener.close()
        raise
    return listener
