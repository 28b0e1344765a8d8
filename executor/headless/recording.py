"""The file of a recorded run: an MCAP file, see `executor.recorder`."""

from __future__ import annotations

import contextlib
import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING, Final, Self

from executor.headless.errors import HeadlessError
from executor.recorder.seekable import SeekableWriter

if TYPE_CHECKING:
    from pathlib import Path

    from translator import Project

__all__ = ["Recording", "check_name", "open_recording"]

ENDING: Final = ".mcap"
MOST_ATTACHED: Final = 8 << 20


def check_name(path: Path) -> None:
    """Refuses a name that is not one of a recording.

    Raises:
        HeadlessError: the name does not end with `.mcap`.
    """
    if path.suffix != ENDING:
        raise HeadlessError(f"{path}: a recording is an MCAP file, so its name ends with {ENDING}.")


class Recording:
    """A recording that is open for writing; use it as a context manager, or close it.

    A full disk stops the recording, not the run; the file stays as it is then.

    Raises:
        OSError: the file cannot be written.
    """

    is_stopped = False

    def __init__(self, path: Path, about: dict[str, str], files: dict[str, bytes]) -> None:
        self.path = path
        self._file = path.open("wb")  # closed by close
        self.writer = SeekableWriter(self._file, about)
        for name, data in sorted(files.items()):
            if len(data) <= MOST_ATTACHED:
                self.writer.attach(name, "application/octet-stream", data)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def stop(self, error: OSError) -> None:
        """Stops the recording after an error of the disk, and says so."""
        self.is_stopped = True
        hint = f"Its begin can be read; `bt-studio convert {self.path} -o OTHER.mcap` completes it."
        sys.stderr.write(f"{self.path}: the recording stops here: {error.strerror}. {hint}\n")

    def close(self) -> None:
        """Completes and closes the file."""
        try:
            if not self.is_stopped:
                self.writer.finish()
        except OSError as error:
            self.stop(error)
        with contextlib.suppress(OSError):  # the reason was written already
            self._file.close()


def open_recording(
    path: Path, project: Project, *, universe: str | None, robot: str | None, seed: int
) -> Recording:
    """Opens the recording of a run, with the project's files as they run.

    Raises:
        HeadlessError: the file cannot be written, or its name is not one of a recording.
    """
    check_name(path)
    settings = project.settings
    about = {
        "project": settings.name,
        "universe": universe or settings.universe,
        "robot": robot or settings.robot or "",
        "seed": str(seed),
        "bt_studio": _version(),
        "python": platform.python_version(),
        "platform": platform.platform(),
    }
    try:
        return Recording(path, about, {f"project/{name}": data for name, data in project.files.items()})
    except OSError as error:
        raise HeadlessError(f"{path}: cannot be written: {error.strerror}") from error


def _version() -> str:
    try:
        return version("bt-studio")
    except PackageNotFoundError:
        return "unknown"
