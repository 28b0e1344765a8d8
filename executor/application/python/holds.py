"""Calls a function before debugpy holds the program: only then can the main thread still report something."""

from __future__ import annotations

import functools
import importlib
import logging
import threading
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

__all__ = ["report_by"]

log = logging.getLogger(__name__)
_MARK: Final = "bt_studio_reports"
_reports: Final[list[Callable[[FrameType], None]]] = []


def report_by(report: Callable[[FrameType], None]) -> None:
    """Calls `report` with the frame that will be held, on the main thread; debugpy must be imported."""
    _reports[:] = [report]
    debugger: Any = importlib.import_module("pydevd").PyDB
    if not hasattr(debugger.do_wait_suspend, _MARK):
        debugger.do_wait_suspend = _reporting(debugger.do_wait_suspend)


def _reporting(wait: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(wait)
    def do_wait_suspend(self: Any, thread: Any, frame: FrameType, *args: Any, **named: Any) -> Any:
        if threading.current_thread() is threading.main_thread():
            for report in _reports:
                try:
                    report(frame)
                except Exception:  # the hold is worth more than its report
                    log.exception("a hold at a line of Python was not reported")
        return wait(self, thread, frame, *args, **named)

    setattr(do_wait_suspend, _MARK, True)
    return do_wait_suspend
