"""Notes which files of the repository each Python process reads, as a `.pth` line while a run is measured.

A process appends to `FOLDER/PID-START` each file below the repository that it executes as a module or
opens, once; the first line names its parent, and whether a test started it. A fork continues in a file with
its name, which also names the one that it came from. A Python file that is opened by others than the import
system is a text, and marked so. Nothing may fail here: users' code runs in processes that may not write.

Which functions run is noted by `executed.c`, in one file for all processes of a worker of pytest (a *lane*).
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:  # the module `typing` would cost each process 5 ms
    from types import FrameType

MARK = "BT_STUDIO_MEASURE"  # of the lane of pytest; lint runs beside it
LANE = "BT_STUDIO_EXECUTED"  # names the lane for what tests start
TEXT = "text:"
# The lane's file is sparse: 16 bytes for each function that a process runs in a test, and a head before them.
RECORDS = 6 << 20
_FROZEN = "<frozen "  # of importlib and zipimport
_REWRITER = "/_pytest/assertion/rewrite.py"
# Their lines are for the reader of an error.
_SHOWN = ("/traceback.py", "/warnings.py", "/_pytest/_code/")
_START_FIELD = 19  # of /proc/PID/stat, after the name in brackets
_MADE = ("/.venv/", "/node_modules/", "/__pycache__/", "/var/", "/.hypothesis/", "/.pytest_cache/")


class Log:
    """The paths that this process read, and the file that they are written to."""

    def __init__(self, folder: str, root: str) -> None:
        self.folder = folder
        self.root = root.rstrip("/") + "/"
        self.seen: set[str] = set()
        self.file = -1
        self.origin = ""
        self.name = ""
        self.lane = ""

    def open(self) -> None:
        """Begins the file of this process."""
        self.file = -1
        with open("/proc/self/stat", "rb") as stat:  # noqa: PTH123 - pathlib costs each process 5 ms
            fields = stat.read().rpartition(b")")[2].split()
        self.name = f"{os.getpid()}-{int(fields[_START_FIELD])}"
        self.file = os.open(f"{self.folder}/{self.name}", os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o666)
        os.write(
            self.file,
            (
                f"parent {int(fields[1])} {'test' if MARK in os.environ else '-'} {self.origin or '-'} "
                f"{self.lane.rpartition('/')[2] or '-'}\n"
            ).encode(),
        )

    def forget_texts(self) -> None:
        """Notes texts again that are read again: the next test reads them, too."""
        self.seen = {path for path in self.seen if not path.startswith(TEXT)}

    def forked(self) -> None:
        """Continues in a file of the forked process."""
        try:
            self.origin = self.name
            if self.file >= 0:
                os.close(self.file)
            self.open()
        except Exception:  # noqa: S110 - a sealed process may not write
            pass

    def hear(self, event: str, arguments: tuple[object, ...]) -> None:
        """Notes the execution of a module's code, or a file that is opened."""
        try:
            if event == "exec":
                path = arguments[0].co_filename  # type: ignore[attr-defined]
            elif event == "open":
                path = arguments[0]
            else:
                return
            if not isinstance(path, str) or path.startswith("<"):
                return
            if not path.startswith("/"):
                path = os.path.abspath(path)  # noqa: PTH100 - pathlib's import would cost each process 5 ms
            if not path.startswith(self.root):
                return
            mark = TEXT if event == "open" and path.endswith(".py") and _is_text(arguments[1]) else ""
            if mark + path in self.seen:
                return
            self.seen.add(mark + path)
            if self.file >= 0 and not any(folder in path for folder in _MADE):
                os.write(self.file, (mark + path[len(self.root) :]).encode() + b"\n")
        except Exception:  # noqa: S110 - as above
            pass


def _is_text(mode: object) -> bool:
    """Returns whether a source is opened to be read, neither to be run nor to be shown with an error."""
    if isinstance(mode, str) and not mode.startswith("r"):
        return False
    frame: FrameType | None = sys._getframe(2)
    names: list[str] = []
    while frame is not None and len(names) < 12:
        names.append(frame.f_code.co_filename)
        frame = frame.f_back
    opened = next((name for name in names if "pathlib" not in name and "tokenize" not in name), "")
    if opened.startswith(_FROZEN) or "/importlib/_bootstrap" in opened or opened.endswith(_REWRITER):
        return False
    return not (opened.endswith("/linecache.py") and any(shown in name for name in names for shown in _SHOWN))


def _lane(folder: str) -> str:
    """Returns the file of this process's lane: named to it, or that of a process above it, or a new one."""
    if named := os.environ.get(LANE):
        return named
    if MARK in os.environ:
        return _new_lane(folder)
    pid = os.getpid()
    while pid > 1:
        with open(f"/proc/{pid}/stat", "rb") as stat:  # noqa: PTH123 - as below
            pid = int(stat.read().rpartition(b")")[2].split()[1])
        if os.path.exists(path := f"{folder}/../executed/{pid}"):  # noqa: PTH110 - as below
            return path
    return ""


def _new_lane(folder: str) -> str:
    path = f"{folder}/../executed/{os.getpid()}"
    file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_TRUNC, 0o666)
    os.fchmod(file, 0o666)
    os.write(file, b"".join(number.to_bytes(4, "little") for number in (1, 0, RECORDS, 0)))
    os.ftruncate(file, 16 + 16 * RECORDS)
    os.close(file)
    return path


def _note_functions(folder: str, root: str) -> str:
    """Begins to note which functions run; returns the lane, or nothing where that is not possible."""
    try:
        import _bt_studio_executed as executed  # type: ignore[import-not-found]

        path = _lane(folder)
        return path if path and executed.begin(root, path, f"{folder}/../keepers") else ""
    except Exception:
        return ""


def begin(folder: str, root: str) -> None:
    """Notes from now on what this process and its forks read."""
    if hasattr(sys, "bt_studio_log"):
        return  # a virtual environment reads its `.pth` files twice
    log = Log(folder, root)
    log.lane = _note_functions(folder, log.root)
    try:
        log.open()
    except OSError:
        return
    sys.bt_studio_log = log  # type: ignore[attr-defined]
    sys.addaudithook(log.hear)
    os.register_at_fork(after_in_child=log.forked)
