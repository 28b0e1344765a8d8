"""The files of a project as the client names them; it may run on another machine than the adapter."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import PurePath

__all__ = ["Folder", "local_root"]

_OF_WINDOWS: Final = re.compile(r"[A-Za-z]:[\\/]|\\\\")
_HINT: Final = '; if the editor runs on another machine, "localRoot" of launch is the project\'s folder there'


def local_root(text: str) -> PurePath | None:
    """Returns an absolute path of POSIX or Windows; None for any other text."""
    path = PureWindowsPath(text) if _OF_WINDOWS.match(text) else PurePosixPath(text)
    return path if path.is_absolute() else None


@dataclass(frozen=True)
class Folder:
    """The folder of a project.

    Attributes:
        here: the folder on this machine.
        local: the same folder on the machine of the client; None if the client runs on this machine.
    """

    here: Path
    local: PurePath | None = None

    def below(self, path: str) -> str:
        """Returns the path below the folder of a file that the client names; `path` if it is not below."""
        if self.local is None:
            return os.path.relpath(Path(path).resolve(), self.here)
        file = type(self.local)(path)
        return file.relative_to(self.local).as_posix() if file.is_relative_to(self.local) else path

    def named(self, below: str) -> tuple[str, str]:
        """Returns the name and the path of a file, as the client names it."""
        file = (self.here if self.local is None else self.local) / below
        return file.name, str(file)

    def hint(self, path: str) -> str:
        """Returns what to do if a file is unknown since the client runs on another machine; else nothing."""
        is_elsewhere = self.below(path).startswith(os.pardir) and not Path(path).exists()
        return _HINT if self.local is None and is_elsewhere else ""
