"""A function is called before debugpy holds the program."""

from __future__ import annotations

import sys
import threading
from types import ModuleType
from typing import Any

import pytest

from executor.application.python import holds


class PyDB:
    """As debugpy's: it notes what it holds."""

    def __init__(self) -> None:
        self.held: list[tuple[Any, ...]] = []

    def do_wait_suspend(self, *held: Any, exception_type: Any = None) -> None:
        self.held.append((*held, exception_type))


@pytest.fixture
def debugger(monkeypatch: pytest.MonkeyPatch) -> PyDB:
    module: Any = ModuleType("pydevd")
    module.PyDB = type("Fresh", (PyDB,), {"do_wait_suspend": PyDB.do_wait_suspend})
    monkeypatch.setitem(sys.modules, "pydevd", module)
    return module.PyDB()


def test_the_report_comes_before_the_hold_and_once(debugger: PyDB) -> None:
    seen: list[Any] = []
    holds.report_by(lambda frame: pytest.fail("of an earlier connection"))
    holds.report_by(lambda frame: seen.append((frame, len(debugger.held))))
    debugger.do_wait_suspend("thread", "frame", "line", None, exception_type=ValueError)
    assert seen == [("frame", 0)]
    assert debugger.held == [("thread", "frame", "line", None, ValueError)]


def test_a_report_that_fails_does_not_keep_the_hold_from_happening(
    debugger: PyDB, caplog: pytest.LogCaptureFixture
) -> None:
    def fails(_: object) -> None:
        raise RuntimeError("no report")

    holds.report_by(fails)
    debugger.do_wait_suspend("thread", "frame", "line", None)
    assert len(debugger.held) == 1
    assert "was not reported" in caplog.text


def test_holds_of_other_threads_are_not_reported(debugger: PyDB) -> None:
    holds.report_by(lambda frame: pytest.fail("another thread"))
    other = threading.Thread(target=debugger.do_wait_suspend, args=("thread", "frame", "line", None))
    other.start()
    other.join()
    assert len(debugger.held) == 1
