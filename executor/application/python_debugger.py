"""Connects the application with the Python debugger of its session.

`debugpy` traces only files of the project. Threads of BT Studio are not traced and not stopped
(`executor.supervision.threads`): a stop would end the signs of life, and the manager the process.
"""

from __future__ import annotations

import importlib
import os
import sys
import threading
import time
from typing import TYPE_CHECKING, Any, Final

from executor.supervision.threads import own

if TYPE_CHECKING:
    from pathlib import Path

    from executor.child_messages import ConnectDebugger

__all__ = ["HOST", "connect", "trace"]

HOST: Final = "127.0.0.1"
PATIENCE_S: Final = 6.0
CLOSING_S: Final = 2.0


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
    import debugpy  # noqa: PLC0415 - slow, and only for who debugs

    api: Any = debugpy
    api.configure(subProcess=False)
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
