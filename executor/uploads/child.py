"""The child: gives up what it does not need, unpacks the upload, then looks into it or imports from it.

It reads the upload, Python and what is installed of ROS, writes its folder, and opens no socket. Macros of
xacro run in their own child with narrower limits (`executor.expansion`).
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import shutil
import sys
import tempfile
import traceback
from pathlib import Path
from typing import IO, Any, Final

from executor.evaluation.sealed.confine import readable_folders
from executor.evaluation.sealed.landlock import DEVICES
from executor.supervision.confine import confine_reader
from executor.supervision.landlock import (
    EXECUTE,
    IOCTL,
    LIST,
    READ,
    TRUNCATE,
    WRITE,
    LandlockError,
    every_right,
    landlock_version,
    restrict,
)
from executor.uploads.check import check
from executor.uploads.look import items
from executor.uploads.trees import make_tree
from executor.uploads.unpacked import UploadError, unpack
from executor.uploads.work import ChoiceError, RefusedError, Wish, make
from tree_gardener.packages import installed_places

MEMORY_BYTES: Final = 1 << 30
SECONDS: Final = 60
ANSWER_BYTES: Final = 64 << 20
_FILE_BYTES: Final = 512 << 20
_HEADER_BYTES: Final = 4 << 20
"""100 arguments of 2,000 characters, of which JSON makes up to 12 bytes each, and the rest."""


def main(folder: str) -> int:
    """Reads `{…}`, a line feed and the upload from standard input; writes the answer as JSON.

    Args:
        folder: an empty folder, which the parent removes.
    """
    scratch = Path(folder).resolve()
    out = os.fdopen(os.dup(1), "w")  # libraries print to standard output
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    confine_reader(MEMORY_BYTES, SECONDS, _FILE_BYTES, children=True)
    if landlock_version():
        with contextlib.suppress(LandlockError):
            restrict(_allowed(scratch))
    tempfile.tempdir = str(scratch)
    os.environ["TMPDIR"] = str(scratch)
    text = json.dumps(_answer(sys.stdin.buffer, scratch))
    if len(text) > ANSWER_BYTES:
        text = json.dumps(
            _error("too_large", f"What would be imported is larger than {ANSWER_BYTES >> 20} MB.")
        )
    out.write(text)
    out.flush()
    return 0


def _allowed(scratch: Path) -> list[tuple[Path, int]]:
    installed = [place.folder for place in installed_places(os.environ)]
    code = Path(__file__).parents[2]
    return [
        *((path, EXECUTE | READ | LIST) for path in (*readable_folders(), *installed)),
        (code, LIST),  # by which the child of the macros finds its modules
        (scratch, every_right() & ~IOCTL),
        *((Path(name), READ | WRITE | TRUNCATE) for name in DEVICES),
    ]


def _answer(data: IO[bytes], scratch: Path) -> dict[str, Any]:
    root, packed = scratch / "upload", scratch / "body"
    try:
        wish = json.loads(data.readline(_HEADER_BYTES))
        root.mkdir()
        with packed.open("w+b") as body:
            shutil.copyfileobj(data, body, 1 << 20)
            notes = unpack(body, wish["filename"], root)
        packed.unlink()  # in the user's tools the disk is memory, and small
        left_out = [{"file": file, "line": None, "text": text} for file, text in notes]
        answer = _made(root, scratch / "project", wish, left_out)
    except UploadError as error:
        return _error(error.code, str(error))
    except MemoryError:
        return _error("too_large", f"Reading it needs more than {MEMORY_BYTES >> 20} MB of memory.")
    except OSError as error:
        return _of_disk(error)
    except Exception as error:
        traceback.print_exc()  # the parent logs the end of it
        return _error("refused", f"It cannot be read: {type(error).__name__}.")
    shown: dict[str, Any] = json.loads(json.dumps(answer).replace(f"{root}/", ""))  # no path of this machine
    return shown


def _made(root: Path, project: Path, wish: dict[str, Any], left_out: list[dict[str, Any]]) -> dict[str, Any]:
    if wish["kind"] == "check":
        return {"findings": check(root)}
    if wish["kind"] == "tree":
        files = [path for path in root.rglob("*") if path.is_file()]
        if len(files) != 1 or files[0].suffix != ".py":
            raise UploadError("bad_archive", "This is not one Python file.")
        return make_tree(files[0], wish["main"])
    if not wish["kind"]:
        return {"items": items(root), "left_out": left_out}
    asked = Wish(wish["kind"], wish["main"], wish["name"], dict(wish["arguments"]), wish["simplify"])
    try:
        answer = make(root, project, asked)
    except ChoiceError as error:
        notes = "; ".join(f"{note['file']}: {note['text']}" for note in left_out[:3])
        return _error("choice", notes, items=error.items)
    except RefusedError as error:
        return _error("refused", str(error), diagnostics=error.diagnostics)
    answer["report"]["left_out"] += left_out
    return answer


def _of_disk(error: OSError) -> dict[str, Any]:
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        return _error("disk_full", "The disk is full.")
    if error.errno == errno.EFBIG:
        return _error("too_large", "A file of it is larger than may be unpacked.")
    return _error("refused", f"A file of it cannot be read: {error.strerror or error}.")


def _error(code: str, message: str, **more: Any) -> dict[str, Any]:
    return {"error": {"code": code, "message": message, **more}}
