"""Opens what the command line imports: a file, a folder, or a zip, which is unpacked until it is read."""

from __future__ import annotations

import contextlib
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from executor.uploads.look import items
from executor.uploads.unpacked import Notes, UploadError, unpack

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextlib.contextmanager
def opened(source: Path) -> Iterator[tuple[Path, Notes]]:
    """Yields a file or folder, and notes; of a zip a temporary folder, and what of it is left out.

    Raises:
        UploadError: the zip cannot be read.
        OSError: the disk is full.
    """
    if not source.is_file() or source.suffix.lower() != ".zip":
        yield source, Notes()
        return
    with source.open("rb") as data, tempfile.TemporaryDirectory(prefix="bt-studio-import-") as folder:
        root = Path(folder, source.stem)
        root.mkdir()
        notes = unpack(data, source.name, root)
        yield root, notes


def chosen(source: Path, kind: str, main: str) -> Path:
    """Returns the main file of an opened source.

    Raises:
        UploadError: it is not there, or not clear.
    """
    if main:
        path = source / main
        # By its words alone: in a workspace that is built with links, a file may be a link out of it.
        if Path(main).is_absolute() or ".." in Path(main).parts or not path.is_file():
            raise UploadError("choice", f"there is no file {main} in it")
        return path
    if not source.is_dir():
        return source
    found = [item for item in items(source) if item["kind"] == kind]
    mains = [str(item["path"]) for item in found if item["is_main"]] or [str(item["path"]) for item in found]
    if len(mains) == 1:
        return source / mains[0]
    if not mains:
        what = "URDF, xacro or SDF file of a robot" if kind == "robot" else "SDF world or map"
        raise UploadError("choice", f"there is no {what} in it")
    raise UploadError(
        "choice", f"several files may be the {kind}: name one by --main: {', '.join(mains[:12])}"
    )
