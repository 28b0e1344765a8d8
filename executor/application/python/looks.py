"""Bounds the looks of a Python debugger at users' values.

debugpy describes values on the thread that is stopped, and waits for methods of the user without end: one
`__repr__` that loops, and the debugger answers nothing until the run is stopped. Where a value does not let
itself be opened, it shows a traceback of its own files. Here such a value alone is shown by a sentence. What
users type into the console may take its time.

A signal ends what takes too long, so only looks at the main thread are bounded, where trees are ticked. A
thread that watches would be stopped by debugpy itself wherever it begins during a hold, as after a fork.
"""

from __future__ import annotations

import functools
import importlib
import os
import signal
import sysconfig
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

__all__ = ["LOOK_S", "EndlessLookError", "bound", "look"]

LOOK_S: Final = 3.0
"""How long one look may take."""
AGAIN_S: Final = 0.2
"""The time until the next method that does not end is ended, of the same look."""
_LOOKS: Final = frozenset(
    {
        "internal_change_variable_json",
        "internal_get_completions",
        "internal_get_exception_details_json",
        "internal_get_variable_json",
    }
)
_EVALUATES: Final = "internal_evaluate_expression_json"
_TYPED: Final = frozenset({None, "repl"})
_DEBUGGER: Final = f"{os.sep}debugpy{os.sep}"
_LIBRARY: Final = (sysconfig.get_path("stdlib"), "<frozen ")


class EndlessLookError(KeyboardInterrupt):
    """Raised in a method of the user that takes too long. debugpy shows a `KeyboardInterrupt`."""

    def __str__(self) -> str:
        return "it does not end"


class _Look:
    """Whether a look is under way; of the main thread alone."""

    is_on = False


@contextmanager
def look(longest_s: float = LOOK_S, again_s: float = AGAIN_S) -> Iterator[None]:
    """Raises `EndlessLookError` in users' code when the block takes too long; within a look, does nothing.

    It is raised again and again, until the block ends: it may have ended one value of many.
    """
    if _Look.is_on or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGALRM, _end_late)
    _Look.is_on = True
    theirs = signal.setitimer(signal.ITIMER_REAL, longest_s, again_s)
    try:
        yield
    finally:
        # `_end_late` raises nothing in this file, so nothing comes between these lines.
        _Look.is_on = False
        signal.setitimer(signal.ITIMER_REAL, *theirs)
        signal.signal(signal.SIGALRM, signal.SIG_DFL if before is None else before)


def bound() -> None:
    """Bounds the looks of debugpy, which was imported. Called before it connects."""
    frames: Any = importlib.import_module("_pydevd_bundle.pydevd_suspended_frames")
    commands: Any = importlib.import_module("_pydevd_bundle.pydevd_comm")
    if getattr(frames, "bt_studio_bounds", False):
        return
    frames.bt_studio_bounds = True
    base, shown = frames._AbstractVariable, frames._ObjectVariable
    base.get_var_data = _always_described(base.get_var_data)
    shown.get_children_variables = _always_opened(shown.get_children_variables, shown)
    command = commands.InternalThreadCommand
    command.do_it = _bounded(command.do_it)


def _end_late(_number: int, frame: FrameType | None) -> None:
    """Raises in users' code, and never in that of the debugger, whose state it would leave half changed."""
    if _Look.is_on and _is_of_user(frame):
        raise EndlessLookError


def _is_of_user(frame: FrameType | None) -> bool:
    """Returns whether users' code runs here: it, or what it called, is above the debugger's."""
    while frame is not None:
        file = frame.f_code.co_filename
        if file == __file__ or _DEBUGGER in file:
            return False
        if not file.startswith(_LIBRARY) or "site-packages" in file:
            return True
        frame = frame.f_back
    return False


def _bounded(do_it: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(do_it)
    def bounded(self: Any, debugger: Any) -> Any:
        name = getattr(self.method, "__name__", "")
        is_watch = name == _EVALUATES and self.args[0].arguments.context not in _TYPED
        if name not in _LOOKS and not is_watch:
            return do_it(self, debugger)
        with look():
            return do_it(self, debugger)

    return bounded


def _always_described(describe: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(describe)
    def described(self: Any, *args: Any, **named: Any) -> Any:
        try:
            with look():
                return describe(self, *args, **named)
        except EndlessLookError as error:  # where debugpy itself does not catch it
            kind = type(self.value).__name__
            text = f"<{kind}; its text: {error}>"
            return {"name": str(self.name), "value": text, "type": kind, "variablesReference": id(self.value)}

    return described


def _always_opened(opened: Callable[..., Any], variable: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(opened)
    def children(self: Any, *args: Any, **named: Any) -> Any:
        try:
            with look():
                return opened(self, *args, **named)
        except BaseException as error:
            return [variable(self.py_db, "(cannot be opened)", _sentence(error), self._register_variable)]

    return children


def _sentence(error: BaseException) -> str:
    try:
        return str(error) if isinstance(error, EndlessLookError) else f"{type(error).__name__}: {error}"
    except Exception:
        return type(error).__name__
