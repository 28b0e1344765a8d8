"""Threads of BT Studio that a Python debugger leaves alone."""

from __future__ import annotations

import subprocess
import sys
import threading

from executor.supervision.threads import own

CODE = """
import threading
import debugpy.server
from _pydevd_bundle.pydevd_utils import get_non_pydevd_threads
from executor.supervision.threads import own
go = threading.Event()
marked, plain = (threading.Thread(target=go.wait, daemon=True, name=n) for n in ("marked", "plain"))
own(marked).start()
plain.start()
print(sorted(thread.name for thread in get_non_pydevd_threads()))
"""


def test_pydevd_does_not_count_a_marked_thread():
    # In a process of its own, since pydevd cannot be unloaded.
    done = subprocess.run(
        [sys.executable, "-c", CODE], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.strip() == "['MainThread', 'plain']"


def test_a_thread_is_marked_and_returned():
    thread = threading.Thread()
    assert own(thread) is thread
    assert vars(thread)["is_pydev_daemon_thread"]
    assert vars(thread)["pydev_do_not_trace"]
