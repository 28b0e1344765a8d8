"""Connects the application with the Python debugger of its session.

`debugpy` traces only files of the project. Threads of BT Studio are not traced and not stopped
(`executor.supervision.threads`): a stop would end the signs of life, and the manager the process.
"""

from __future__ import annotations

import importlib
import os
import queue
import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.application.python import holds, looks, stops
from executor.child_messages import ConnectDebugger, Log, PythonLineWrong
from executor.supervision.threads import own

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

    from executor.child_messages import ToApplication
    from executor.supervision.pulse import Pulse

__all__ = ["HOST", "PythonDebugger", "connect", "trace"]

HOST: Final = "127.0.0.1"
PATIENCE_S: Final = 6.0
CLOSING_S: Final = 2.0
TURN_S: Final = 0.05
LATE: Final = "The Python debugger was late: breakpoints in Python hold the run only from now on."


class PythonDebugger:
    """The connection of an application with the Python debugger of its session, if it has one.

    Args:
        pulse: the signs of life of the process.
        send: sends the manager a message.
        report: is called with the frame that will be held at a line.
    """

    def __init__(
        self,
        pulse: Pulse,
        send: Callable[[Log | PythonLineWrong], None],
        report: Callable[[FrameType], None],
    ) -> None:
        self.is_connected = False
        self._report = report
        self._pulse = pulse
        self._send = send

    def wait(self, commands: queue.SimpleQueue[ToApplication]) -> None:
        """Waits for the order to connect, and obeys it; other commands stay in the queue."""
        left: list[ToApplication] = []
        until_s = time.monotonic() + PATIENCE_S
        while (left_s := until_s - time.monotonic()) > 0:
            try:
                message = commands.get(timeout=min(left_s, TURN_S))
            except queue.Empty:
                self._pulse.moved()
                continue
            if isinstance(message, ConnectDebugger):
                self.connect(message)
                break
            left.append(message)
        else:
            self._send(Log("warning", LATE))
        for message in left:
            commands.put(message)

    def connect(self, wanted: ConnectDebugger) -> None:
        """Connects with the adapter of the session, and reports if that is late or not possible."""
        console = sys.stdout  # as for prints: with the block that writes, and a limit for floods
        stops.tell_by(
            lambda text: print(text, file=console),
            lambda path, line, text: self._send(PythonLineWrong(path, line, text)),
        )
        try:
            with self._pulse.busy("connecting"):  # its import takes a second or more
                is_ready = connect(wanted, Path.cwd())
                holds.report_by(self._report)
            self.is_connected = True
        except Exception as error:
            self._send(Log("warning", f"The Python debugger cannot be connected: {error}"))
        else:
            if not is_ready:
                self._send(Log("warning", LATE))


def connect(wanted: ConnectDebugger, folder: Path, patience_s: float = PATIENCE_S) -> bool:
    """Connects this process with the adapter of the session; call it on the main thread.

    Waits until the client has set its breakpoints. Returns whether it has within `patience_s`; they take
    effect later otherwise.

    Args:
        wanted: the port and the token of the adapter.
        folder: the folder of the application, whose files are traced.
        patience_s: the longest wait, in s.

    Raises:
        OSError, RuntimeError: the adapter is not there.
    """
    os.environ["IDE_PROJECT_ROOTS"] = str(folder)
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # it warns of Python's frozen modules
    os.environ["PYDEVD_WARN_SLOW_RESOLVE_TIMEOUT"] = "10"  # a busy machine is no reason for a warning
    # It would say `continued` in the midst of a slow look; `looks` ends it instead.
    os.environ["PYDEVD_UNBLOCK_THREADS_ON_VARIABLES_TIMEOUT"] = "-1"
    import debugpy  # noqa: PLC0415 - slow, and only for who debugs

    api: Any = debugpy
    api.configure(subProcess=False)
    looks.bound()
    _end_last_connection()
    late: list[bool] = []
    timer = own(threading.Timer(patience_s, _give_up, (late,)))
    timer.daemon = True
    timer.start()
    try:
        api.connect((HOST, wanted.port), access_token=wanted.token)
    finally:
        timer.cancel()
    return not late


def trace(*, is_on: bool) -> None:
    """Starts or stops the tracing of the main thread; without breakpoints it would only cost."""
    if "debugpy" in sys.modules:
        api: Any = sys.modules["debugpy"]
        api.trace_this_thread(is_on)


def _end_last_connection() -> None:
    """Ends a connection that is still closing: debugpy would take it for the new one, and not connect."""
    until_s = time.monotonic() + CLOSING_S
    while _connection() is not None and time.monotonic() < until_s:
        importlib.import_module("pydevd").stoptrace()  # waits for the threads of the connection


def _connection() -> Any:
    return importlib.import_module("_pydevd_bundle.pydevd_constants").get_global_debugger()


def _give_up(late: list[bool]) -> None:
    """Ends a wait for a client that has gone: debugpy itself would wait without end."""
    late.append(True)
    debugger = _connection()
    if debugger is not None:
        debugger.ready_to_run = True
