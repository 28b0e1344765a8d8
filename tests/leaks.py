"""A run of pytest fails if it leaves processes, containers, cgroups, shared memory or temporary files.

After each test file it looks what is there that was not before, and the error names the file after which a
leak was seen first. Others may work on the machine at the same time, so only what is known to be ours counts:

* processes that have the mark of this run in their environment, which children inherit, or descend from it;
* all that is in the temporary folder of this run, which `tempfile` uses instead of the machine's;
* shared memory and control groups below ours that one of these processes was seen to use;
* containers that mention the mark or a folder of this run.

A process that has cleared its environment and whose parents have ended is known if it was seen before that.
Written without packages, since the engine's tests run where few are installed.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import pytest

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable, Iterator

MARK: Final = "TEST_RUN_MARK"
END_S: Final = 20.0
"""So long a process that was ended may take to be gone; a run without leaks does not wait."""
# pytest keeps the folders of `tmp_path` for the developer, and removes old ones.
KEPT: Final = "PYTEST_DEBUG_TEMPROOT"
_PROCESSES: Final = Path("/proc")
_SHARED_MEMORY: Final = Path("/dev/shm")  # noqa: S108 - it is where shared memory is, not a temporary file
_GROUPS: Final = Path("/sys/fs/cgroup")
_ENGINE: Final = Path("/var/run/docker.sock")
_LONGEST_NAME: Final = 160
_KEPT_BY_OTHERS: Final = frozenset({"ray"})
"""Folders that programs of others keep for a reader: Ray's logs."""


class Process(NamedTuple):
    """A process; its number alone is used again by others."""

    pid: int
    began: str


class Leak(NamedTuple):
    """Something that is left, and the test file after which it was seen first."""

    what: str
    name: str
    file: str

    def __str__(self) -> str:
        return f"{self.file} - leaves {self.what} behind: {self.name}"


class Leaks:
    """What this run has made, and where each was seen first."""

    def __init__(self) -> None:
        self._old = {name: os.environ.get(name) for name in (MARK, KEPT, "TMPDIR")}
        self._old_folder = tempfile.tempdir
        machine = tempfile.gettempdir()
        self.mark = secrets.token_hex(8)
        # A short name: sockets are in such folders. Others than the user may run programs of a test.
        self.folder = Path(tempfile.mkdtemp(prefix="t-"))
        self.folder.chmod(0o1777)
        os.environ.setdefault(KEPT, machine)
        os.environ |= {MARK: self.mark, "TMPDIR": str(self.folder)}
        tempfile.tempdir = str(self.folder)
        self.is_over = False
        self._others = set(_pids()) - {os.getpid()}
        self._processes: dict[Process, str] = {}
        self._files: dict[Path, str] = {}
        self._shared_before = set(_names(_SHARED_MEMORY))
        # Names are used again: the ports of Fast DDS, also by processes that a later test kills.
        self._shared: dict[tuple[Path, int], str] = {}
        self._own_groups = _groups_of(os.getpid())
        self._groups_before = {each for own in self._own_groups for each in _below(own)}
        self._groups: dict[Path, str] = {}
        self._containers_before = set(_containers())

    def look(self, file: str) -> None:
        """Notes what is new after a test file."""
        self._look_at_processes(file)
        for name in set(_names(self.folder)) - _KEPT_BY_OTHERS:
            self._files.setdefault(self.folder / name, file)
        ours = [process for process in self._processes if _is_alive(process)]
        names = set(_names(_SHARED_MEMORY)) - self._shared_before
        new = {(path := _SHARED_MEMORY / name, _number(path)) for name in names} - self._shared.keys()
        if new:
            mapped = _mapped([os.getpid(), *(process.pid for process in ours)])
            self._shared |= {each: file for each in new if each[0] in mapped}
        for process in ours:
            for group in _groups_of(process.pid) - self._groups_before - self._own_groups:
                if any(group.is_relative_to(own) for own in self._own_groups):
                    self._groups.setdefault(group, file)

    def found(self, file: str, kept: Iterable[str] = ()) -> list[Leak]:
        """Returns what is left at the end of the session; `kept` are folders that containers may mention."""
        self._others.clear()  # numbers may have been used again
        self.look(file)
        end_s = time.monotonic() + END_S
        while left := [process for process in self._processes if _is_alive(process)]:
            if time.monotonic() > end_s:
                break
            time.sleep(0.05)
        used = _mapped(_pids()) if self._shared else set()
        ours = (self.mark, str(self.folder), *kept)
        return [
            *(Leak("a process", _described(each), self._processes[each]) for each in left),
            *(Leak("a temporary file", str(path), first) for path, first in self._files.items() if _is(path)),
            *(
                Leak("shared memory", str(path), first)
                for (path, number), first in self._shared.items()
                if path not in used and _number(path) == number
            ),
            *(Leak("a control group", str(path), first) for path, first in self._groups.items() if _is(path)),
            *(
                Leak("a container", name, file)
                for name in _containers()
                if name not in self._containers_before and _mentions(name, ours)
            ),
        ]

    def end(self) -> None:
        """Restores the temporary folder of the machine."""
        if self.is_over:
            return
        self.is_over = True
        tempfile.tempdir = self._old_folder
        for name, value in self._old.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
        shutil.rmtree(self.folder, ignore_errors=True)

    def _look_at_processes(self, file: str) -> None:
        mark = f"{MARK}={self.mark}".encode()
        parents = {process.pid for process in self._processes} | {os.getpid()}
        known = self._others | parents
        for pid in sorted(_pids()):  # a child mostly has a higher number than its parent
            if pid in known:
                continue
            try:
                began, parent = _stat(pid)
                is_ours = parent in parents or mark in (_PROCESSES / str(pid) / "environ").read_bytes()
            except OSError:  # it has ended, or belongs to another user
                continue
            if is_ours:
                self._processes[Process(pid, began)] = file
                parents.add(pid)
            else:
                self._others.add(pid)


_LEAKS: Final = pytest.StashKey[Leaks]()
_FOUND: Final = pytest.StashKey[list[Leak]]()
_NOT_RUN: Final = "tests"


def pytest_configure(config: pytest.Config) -> None:
    config.stash[_LEAKS] = Leaks()
    config.stash[_FOUND] = []
    config.pluginmanager.register(FromWorkers())


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> Generator[None]:
    try:
        yield
    finally:
        if nextitem is None or nextitem.path != item.path:
            item.config.stash[_LEAKS].look(_file(item))


class FromWorkers:
    """Collects what each process of pytest-xdist has left; they know it, and not the one that prints."""

    @staticmethod
    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(node: Any) -> None:
        found = getattr(node, "workeroutput", {}).get(MARK, ())  # there is none of one that crashed
        node.config.stash[_FOUND] += [Leak(*each) for each in found]


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    last = _file(session.items[-1]) if getattr(session, "items", None) else _NOT_RUN
    base = getattr(session.config, "_tmp_path_factory", None)
    kept = [str(base.getbasetemp())] if base is not None and _ENGINE.exists() else []
    found = session.config.stash[_FOUND]
    found += session.config.stash[_LEAKS].found(last, kept)
    if (output := getattr(session.config, "workeroutput", None)) is not None:
        output[MARK] = [tuple(leak) for leak in found]
    if found and session.exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    found = terminalreporter.config.stash[_FOUND]
    if found:
        terminalreporter.section("leaks", red=True)
    for leak in found:
        terminalreporter.write_line(f"ERROR {leak}")


def pytest_unconfigure(config: pytest.Config) -> None:
    config.stash[_LEAKS].end()


def _file(item: pytest.Item) -> str:
    return item.nodeid.partition("::")[0]


def _pids() -> list[int]:
    return [int(name) for name in _names(_PROCESSES) if name.isdecimal()]


def _names(folder: Path) -> list[str]:
    try:
        return os.listdir(folder)  # noqa: PTH208 - names are enough, and it is called after each file
    except OSError:
        return []


def _is(path: Path) -> bool:
    return os.path.lexists(path)


def _stat(pid: int) -> tuple[str, int]:
    """Returns when a process began, and its parent."""
    fields = (_PROCESSES / str(pid) / "stat").read_text(errors="replace").rpartition(") ")[2].split()
    if fields[0] in "ZX":
        raise ProcessLookupError
    return fields[19], int(fields[1])


def _is_alive(process: Process) -> bool:
    try:
        return _stat(process.pid)[0] == process.began
    except OSError:
        return False


def _described(process: Process) -> str:
    words = b""
    with contextlib.suppress(OSError):
        words = (_PROCESSES / str(process.pid) / "cmdline").read_bytes()
    return f"{process.pid} {words.replace(bytes(1), b' ').decode(errors='replace')}"[:_LONGEST_NAME].strip()


def _number(path: Path) -> int:
    """Returns the inode of a file; -1 if there is none."""
    try:
        return path.stat().st_ino
    except OSError:
        return -1


def _mapped(pids: Iterable[int]) -> set[Path]:
    """Returns the shared memory that processes have mapped."""
    found = set()
    for pid in pids:
        with contextlib.suppress(OSError):
            for line in (_PROCESSES / str(pid) / "maps").read_text(errors="replace").splitlines():
                place, is_shared, name = line.partition(f"{_SHARED_MEMORY}/")
                if place and is_shared:
                    found.add(_SHARED_MEMORY / name.removesuffix(" (deleted)"))
    return found


def _groups_of(pid: int) -> set[Path]:
    """Returns the folders of the control groups of a process; of version 1 one for each controller."""
    found = set()
    with contextlib.suppress(OSError):
        for line in (_PROCESSES / str(pid) / "cgroup").read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            found.add(_GROUPS / controllers.removeprefix("name=") / path.lstrip("/"))
    return found


def _below(group: Path) -> Iterator[Path]:
    for folder, folders, _ in os.walk(group):
        yield from (Path(folder, name) for name in folders)


def _containers() -> list[str]:
    return _docker("ps", "--all", "--format", "{{.Names}}").split()


def _mentions(container: str, texts: Iterable[str]) -> bool:
    document = _docker("inspect", container)
    return any(text in document for text in texts)


def _docker(*arguments: str) -> str:
    if not _ENGINE.exists() or shutil.which("docker") is None:
        return ""
    try:
        done = subprocess.run(
            ["docker", *arguments], capture_output=True, text=True, check=False, timeout=END_S
        )
    except subprocess.TimeoutExpired:
        return ""
    return done.stdout
