"""The reasons for which a run cannot be copied are found, and named."""

from __future__ import annotations

import socket
import sys
import threading
from types import ModuleType
from typing import TYPE_CHECKING

from executor.exact.foreign import Foreign, Threads
from executor.supervision.threads import own
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    import pytest


def test_a_thread_of_an_action_is_named() -> None:
    foreign, end = Foreign(), threading.Event()
    assert foreign.refusal("") == ""
    thread = threading.Thread(target=end.wait, name="grabber")
    thread.start()
    assert foreign.refusal("") == "the thread “grabber” of the module threading runs in it"
    assert Foreign().refusal("") == ""  # it was there before
    end.set()
    thread.join()
    wait_until(lambda: foreign.refusal("") == "", "the kernel has ended it, too")


def test_our_own_threads_do_not_count() -> None:
    foreign, end = Foreign(), threading.Event()
    thread = own(threading.Thread(target=end.wait))
    thread.start()
    assert foreign.refusal("") == ""
    end.set()
    thread.join()


def test_a_connection_is_named() -> None:
    foreign = Foreign()
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM):
        assert foreign.refusal("") == "it holds a network connection"
    assert foreign.refusal("") == ""


def test_the_renderer_must_be_in_software(monkeypatch: pytest.MonkeyPatch) -> None:
    foreign = Foreign()
    assert foreign.refusal("moderngl on llvmpipe (LLVM 15.0.7, 256 bits)") == ""
    assert foreign.refusal("TinyRenderer") == ""
    assert "NVIDIA" in foreign.refusal("moderngl on NVIDIA H100")
    monkeypatch.setitem(sys.modules, "debugpy", ModuleType("debugpy"))
    assert foreign.refusal("") == "the Python debugger is connected"


def test_threads_of_python_are_not_looked_at() -> None:
    threads = Threads()
    assert isinstance(threads.are_at_rest, bool)
    assert isinstance(threads.have_waited(), bool)
