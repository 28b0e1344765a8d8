"""The child: gives up what it does not need, then expands a document or builds a tree of py_trees.

Three layers: limits of memory, time and output; Landlock, by which it reads the folders of the job and
nothing else; and a hook in Python that refuses sockets, programs and files outside, also where the kernel has
no Landlock.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
import sysconfig
from pathlib import Path
from typing import Any, Final

import yaml  # noqa: F401 - xacro imports it on demand, when nothing can be imported any more

from executor.expansion.tracked import ExpansionError, expand
from executor.supervision.confine import confine_reader
from executor.supervision.landlock import LIST, READ, LandlockError, landlock_version, restrict
from tree_gardener.packages import Packages, Place

MEMORY_BYTES: Final = 512 << 20
SECONDS: Final = 10
ANSWER_BYTES: Final = 16 << 20
_REFUSED: Final = (
    *("socket.", "subprocess.", "os.exec", "os.posix_spawn", "os.spawn", "os.fork", "os.system"),
    *("os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.link", "os.symlink", "os.truncate", "os.putenv"),
    *("ctypes.", "mmap.", "pty.", "shutil.", "urllib.", "ftplib.", "http.", "os.kill", "signal.", "syslog."),
)
_WRITING: Final = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC
_PACKAGES: Final = frozenset({"site-packages", "dist-packages"})
_NAMES: Final = frozenset({"open", "os.listdir", "os.scandir"})


def main() -> int:
    """Reads a job from standard input, and writes the answer as JSON; returns the exit status."""
    job = json.load(sys.stdin)
    confine_reader(MEMORY_BYTES, SECONDS, ANSWER_BYTES)
    file = job.get("py_trees") or job["file"]
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        answer = _built(Path(file), job["main"]) if "py_trees" in job else _expanded(job)
    text = json.dumps(answer)
    if len(text) > ANSWER_BYTES:
        text = json.dumps({"error": "the document is larger than 16 MB", "file": file, "line": 1})
    sys.stdout.write(text)
    sys.stdout.flush()
    return 0


def seal(folders: list[Path]) -> None:
    """Gives up all files outside of these folders, the network, and other programs."""
    if landlock_version():
        with contextlib.suppress(LandlockError):
            restrict((folder, READ | LIST) for folder in folders)
    roots = tuple(os.path.realpath(folder) for folder in folders)
    is_watching = True

    def watch(event: str, arguments: tuple[Any, ...]) -> None:
        nonlocal is_watching
        if event.startswith(_REFUSED):
            raise PermissionError(1, "a robot file may not do that", event)
        if event == "open" and (arguments[2] or 0) & _WRITING:
            raise PermissionError(1, "a robot file may not do that", event)
        if event in _NAMES and is_watching and isinstance(arguments[0], str | bytes):
            is_watching = False  # what is called here opens nothing
            try:
                real = os.path.realpath(os.fsdecode(arguments[0]))
            finally:
                is_watching = True
            if not any(real == root or real.startswith(root.rstrip("/") + "/") for root in roots):
                raise PermissionError(13, "it lies outside of the project", os.fsdecode(arguments[0]))

    sys.addaudithook(watch)


def _built(file: Path, main: str) -> dict[str, Any]:
    """Builds a tree of py_trees; its file may also import what is installed."""
    from executor.expansion.py_trees_file import BuildError, build  # noqa: PLC0415 - xacro needs no py_trees

    with contextlib.suppress(ImportError):
        import numpy  # noqa: F401, PLC0415 - it may not load libraries later
    installed = [Path(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib", "purelib", "platlib")]
    # Also what a sourced workspace and the user have installed; other folders of the path hold data, too.
    installed += [path for entry in sys.path if (path := Path(entry)).name in _PACKAGES]
    seal([file.parent, *(folder for folder in dict.fromkeys(installed) if folder.is_dir())])
    try:
        return build(file, main)
    except BuildError as error:
        return {"error": str(error), "file": error.file, "line": error.line, "choices": error.choices}
    except Exception as error:
        return {"error": f"the tree cannot be read: {type(error).__name__}", "file": str(file), "line": 1}


def _expanded(job: dict[str, Any]) -> dict[str, Any]:
    seal([Path(folder) for _, folder in (*job["places"], *job["installed"])])
    file = Path(job["file"])
    places, installed = (
        [Place(shown, Path(folder)) for shown, folder in job[key]] for key in ("places", "installed")
    )
    packages = Packages(file.parent, places, installed)
    try:
        made = expand(file, packages, job["arguments"], is_lenient=job.get("is_lenient", False))
    except ExpansionError as error:
        return {"error": str(error), "file": error.place.file, "line": error.place.line}
    except MemoryError:
        return {"error": "the document needs more than 512 MB", "file": job["file"], "line": 1}
    files = list(dict.fromkeys(place.file for place in made.places))
    numbers = {name: i for i, name in enumerate(files)}
    lines = [[numbers[place.file], place.line] for place in made.places]
    return {"text": made.text, "files": files, "lines": lines, "notes": packages.notes}
