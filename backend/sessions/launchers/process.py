"""Runs executors in child processes of the web server; they end with the web server.

The manager asks the kernel for a signal when its parent dies. That signal comes when the *thread*
that forked ends, so one thread, which lives as long as the server, starts all managers.
"""

from __future__ import annotations

import contextlib
import json
import logging
import os
import select
import subprocess
import sys
import time
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from threading import Lock
from typing import IO, TYPE_CHECKING, Final

import psutil

from backend.config.environment import REPOSITORY
from backend.sessions.errors import LaunchError
from backend.sessions.launchers.base import UNKNOWN_EXIT, WARM, Launcher, Spec, Started, State

if TYPE_CHECKING:
    from pathlib import Path

_log = logging.getLogger(__name__)

TOKEN_VARIABLE: Final = "BT_STUDIO_MANAGER_TOKEN"  # noqa: S105 - the name, not the token
STDERR_LINES: Final = 20
RUNS: Final = "runs"
"""The folder in that of a session which has its recordings; the manager's own files are beside it."""
LATER: Final = "-"
"""Stands for a target that the manager reads from its standard input (`executor.manager.order`)."""
SPARE_S: Final = 240.0
"""The age up to which a spare manager is given away; without clients it ends by itself after 300 s."""
CLOSE_S: Final = 5.0
"""The time that all managers together have to end at the end of the server."""
OURS: Final = "BT_STUDIO_"
FOR_EXECUTORS: Final = frozenset(
    {
        "BT_STUDIO_APPLICATION_CPU_S",
        "BT_STUDIO_APPLICATION_FILE_MB",
        "BT_STUDIO_APPLICATION_MEMORY_MB",
        "BT_STUDIO_APPLICATION_PROCESSES",
        "BT_STUDIO_EVALUATION_MEMORY_MB",
        "BT_STUDIO_HOLD_MINUTES",
        "BT_STUDIO_RENDERER",
    }
)
"""Our variables that executors read; all others stay here."""


@dataclass(frozen=True)
class _Spare:
    """A manager that was started before its session."""

    made_id: str
    since_s: float
    started: Future[Started]

    @property
    def is_fresh(self) -> bool:
        return time.monotonic() - self.since_s < SPARE_S


class ProcessLauncher(Launcher):
    """Starts an executor's manager on a free port of the loopback interface.

    Args:
        log_folder: gets the output of each executor.
        command: the program.
        recordings: has a folder for each session, in which its recordings are left when it ends.
    """

    name = "process"
    shares_network = True

    def __init__(
        self,
        log_folder: Path,
        command: tuple[str, ...] = (sys.executable, "-m", "executor.manager"),
        recordings: Path | None = None,
    ) -> None:
        self.log_folder = log_folder
        self.recordings = recordings
        self._command = command
        self._thread = ThreadPoolExecutor(max_workers=1, thread_name_prefix="launcher")
        self._children: dict[int, subprocess.Popen[bytes]] = {}
        self._spare: _Spare | None = None
        self._lock = Lock()

    def start(self, spec: Spec) -> Started:
        """Starts a manager, or takes the spare one, and waits until it listens."""
        if not spec.target:
            return self._bring_up(spec)
        started = self._take_spare(spec) or self._bring_up(spec)
        try:
            self._order(started.state["pid"], spec)
        except OSError as error:
            self.stop(started.state, timeout_s=spec.stop_timeout_s)
            raise LaunchError(f"The session ended as it started: {error}.") from error
        return started

    def prepare(self, spec: Spec) -> None:
        """Starts a manager for the next session with a target, unless one waits already."""
        spare = _Spare(spec.session_id, time.monotonic(), Future())
        with self._lock:
            if self._spare is not None and self._spare.is_fresh:
                return
            self._spare = spare
        try:
            spare.started.set_result(self._bring_up(replace(spec, target=LATER)))
        except LaunchError as error:
            spare.started.set_exception(error)
            raise

    def _take_spare(self, spec: Spec) -> Started | None:
        """Returns the spare manager, which belongs to the caller from now on; None if none runs."""
        with self._lock:
            spare, self._spare = self._spare, None
        if spare is None or not spare.is_fresh:
            return None
        try:
            started = spare.started.result(spec.start_timeout_s)
        except (LaunchError, TimeoutError):
            return None
        if self.poll(started.state) is not None:
            return None
        return Started(started.address, started.state | {WARM: spare.made_id})

    def _order(self, pid: int, spec: Spec) -> None:
        """Writes to a manager which program it follows, and where its recordings are left."""
        folder = "" if self.recordings is None else str(self.recordings / spec.session_id / RUNS)
        with self._lock:
            child = self._children[pid]
        assert child.stdin is not None  # noqa: S101 - `_spawn` makes the pipe
        child.stdin.write(json.dumps({"target": spec.target, "recordings": folder}).encode() + b"\n")
        child.stdin.flush()

    def _bring_up(self, spec: Spec) -> Started:
        """Starts a manager, and waits for the line that it writes to its ready pipe."""
        ready_read, ready_write = os.pipe()
        log = self.log_folder / f"{spec.session_id}.log"
        try:
            with open(ready_read, "rb", buffering=0) as ready:  # noqa: PTH123 - a file descriptor
                try:
                    child = self._thread.submit(self._spawn, spec, ready_write, log).result()
                finally:
                    os.close(ready_write)
                port = _await_port(ready, spec.start_timeout_s)
        except OSError as error:
            raise LaunchError(f"The session could not be started: {error}.") from error
        state = {"pid": child.pid, "created": _created(child.pid)}
        if port is None:
            status = _status_of(child)
            self.stop(state, timeout_s=spec.stop_timeout_s)
            _log.warning("the executor of session %s ended with status %s", spec.session_id, status)
            raise LaunchError(_why(status, spec.start_timeout_s), hint=_last_lines(log))
        return Started(f"127.0.0.1:{port}", state)

    def poll(self, state: State) -> int | None:
        """Returns the exit status of a child that has ended; None while it runs."""
        with self._lock:
            child = self._children.get(state["pid"])
        if child is not None:
            return child.poll()
        return None if _find(state) else UNKNOWN_EXIT

    def stop(self, state: State, *, timeout_s: float) -> None:
        """Asks the manager to end, and kills its remaining processes after a timeout."""
        process = _find(state)
        with self._lock:
            child = self._children.get(state["pid"])
        if process:
            family = _descendants(process)
            with contextlib.suppress(psutil.Error):
                process.terminate()
            if not _is_stopped(process):
                _wait(process, child, timeout_s)
            family = [*{*family, *_descendants(process)}, process]
            for member in family:
                with contextlib.suppress(psutil.Error):
                    member.kill()
            _wait(process, child, timeout_s)
            _await_ends([member for member in family if member != process], timeout_s)
        if child is not None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                child.wait(timeout_s)
            if child.stdin:
                child.stdin.close()

    def close(self) -> None:
        """Ends every executor and the thread that started them, at the end of the server."""
        with self._lock:
            children = list(self._children.values())
        for child in children:
            child.terminate()
        # They end beside each other. A manager that is killed leaves its folder to the next one.
        end_s = time.monotonic() + CLOSE_S
        for child in children:
            left_s = max(1.0, end_s - time.monotonic())
            self.stop({"pid": child.pid, "created": _created(child.pid)}, timeout_s=left_s)
        self._thread.shutdown()

    def _spawn(self, spec: Spec, ready_fd: int, log: Path) -> subprocess.Popen[bytes]:
        log.parent.mkdir(parents=True, exist_ok=True)
        arguments = ("--host", "127.0.0.1", "--port", "0")
        options: tuple[str, ...] = ("--token-env", TOKEN_VARIABLE, "--ready-fd", str(ready_fd))
        if spec.target:
            options += ("--attach", LATER)
        elif self.recordings is not None:
            options += ("--recordings", str(self.recordings / spec.session_id / RUNS))
        with log.open("wb") as output:
            child = subprocess.Popen(
                (*self._command, *arguments, *options),
                cwd=REPOSITORY,
                env=_environment(spec),
                # Only the order to follow a program is written to the pipe.
                stdin=subprocess.PIPE,
                stdout=output,
                stderr=subprocess.STDOUT,
                pass_fds=(ready_fd,),
                start_new_session=True,
            )
        with self._lock:
            self._children[child.pid] = child
        return child


def _environment(spec: Spec) -> dict[str, str]:
    """Returns the environment of an executor.

    It is the web server's without secrets, with the session's ROS variables.
    """
    kept = {
        name: value
        for name, value in os.environ.items()
        if name in FOR_EXECUTORS or not name.startswith(OURS)
    }
    return kept | {
        TOKEN_VARIABLE: spec.token,
        "ROS_DOMAIN_ID": str(spec.ros_domain_id),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "PYTHONUNBUFFERED": "1",
    }


def _await_port(ready: IO[bytes], timeout_s: float) -> int | None:
    """Returns the port from the ready line; None if the child ends or the time runs out first."""
    deadline = time.monotonic() + timeout_s
    line = b""
    while not line.endswith(b"\n"):
        left = deadline - time.monotonic()
        if left <= 0 or not select.select([ready], [], [], left)[0]:
            return None
        chunk = os.read(ready.fileno(), 4096)
        if not chunk:
            return None
        line += chunk
    try:
        return int(json.loads(line)["port"])
    except (ValueError, KeyError, TypeError):
        return None


def _why(status: int | None, timeout_s: float) -> str:
    if status is None:
        return f"The session was not ready within {timeout_s:g} s."
    return f"The session ended before it was ready{f' (exit status {status})' if status > 0 else ''}."


def _last_lines(log: Path) -> str:
    try:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    return "\n".join(lines[-STDERR_LINES:])


def _status_of(child: subprocess.Popen[bytes]) -> int | None:
    """Returns the exit status of a child whose ready pipe is closed; None if the child does not end soon."""
    with contextlib.suppress(subprocess.TimeoutExpired):
        return child.wait(timeout=0.5)
    return None


def _wait(process: psutil.Process, child: subprocess.Popen[bytes] | None, timeout_s: float) -> None:
    """Waits for the end of a process.

    Only `Popen` may collect its child, otherwise the exit status is lost.
    """
    with contextlib.suppress(psutil.Error, subprocess.TimeoutExpired):
        if child is not None:
            child.wait(timeout_s)
        else:
            process.wait(timeout_s)


def _await_ends(family: list[psutil.Process], timeout_s: float) -> None:
    """Waits until killed processes have ended; those whose parent is gone may be reaped late, or never."""
    deadline_s = time.monotonic() + timeout_s
    while any(map(_runs, family)) and time.monotonic() < deadline_s:
        time.sleep(0.01)


def _runs(process: psutil.Process) -> bool:
    try:
        return bool(process.is_running() and process.status() != psutil.STATUS_ZOMBIE)
    except psutil.Error:
        return False


def _is_stopped(process: psutil.Process) -> bool:
    """Whether a process is stopped, as by SIGSTOP: it does not get the signal that asks it to end."""
    try:
        return bool(process.status() == psutil.STATUS_STOPPED)
    except psutil.Error:
        return False


def _created(pid: int) -> float:
    try:
        return psutil.Process(pid).create_time()
    except psutil.Error:
        return 0.0


def _find(state: State) -> psutil.Process | None:
    """Returns the process of this state, or None.

    Its start time distinguishes it from a later process with the same number.
    """
    try:
        process = psutil.Process(state["pid"])
        same = abs(process.create_time() - state["created"]) < 0.01
        return process if same and process.status() != psutil.STATUS_ZOMBIE else None
    except psutil.Error:
        return None


def _descendants(process: psutil.Process) -> list[psutil.Process]:
    try:
        return process.children(recursive=True)
    except psutil.Error:
        return []
