"""The process that runs users' code finds their modules."""

from __future__ import annotations

import subprocess
import sys
import textwrap
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from executor.application import host
from executor.child_messages import Pause, Stop
from executor.supervision.channel import encode, socket_pair

if TYPE_CHECKING:
    import socket
    from collections.abc import Iterator

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = """
import os, sys
from pathlib import Path
from executor.application.host import enter
leave = enter(Path(sys.argv[1]))
import helper
assert os.getcwd() == sys.argv[1] and helper.VALUE == 5
leave()
assert sys.argv[1] not in sys.path
print("well")
"""


def test_modules_of_the_project_are_found_in_its_folder(tmp_path: Path) -> None:
    (tmp_path / "actions").mkdir()
    (tmp_path / "actions" / "helper.py").write_text("VALUE = 5\n")
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.returncode) == ("well\n", 0), done.stderr
    assert host.enter.__doc__


TIMEOUT_S = 60
LISTENER = """
    import signal, sys
    from executor.child_messages import decode_to_application
    from executor.supervision.channel import Channel
    from executor.application.host import start_listener
    channel = Channel(int(sys.argv[1]), decode_to_application)
    start_listener(channel, lambda message: print(type(message).__name__, flush=True))
    signal.pause()
"""


@contextmanager
def listening() -> Iterator[tuple[socket.socket, subprocess.Popen[str]]]:
    """A process that listens and prints what it takes, and the manager's end of its channel."""
    ours, theirs = socket_pair()
    command = [sys.executable, "-c", textwrap.dedent(LISTENER), str(theirs.fileno())]
    process = subprocess.Popen(
        command, pass_fds=[theirs.fileno()], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    theirs.close()
    try:
        yield ours, process
    finally:
        ours.close()
        process.kill()
        process.wait()


def test_messages_are_taken_in_order_and_the_process_ends_with_its_manager() -> None:
    with listening() as (manager, process):
        manager.sendall(encode(Pause()) + encode(Stop()))
        manager.close()
        said, trouble = process.communicate(timeout=TIMEOUT_S)
        assert (said.split(), trouble, process.returncode) == (["Pause", "Stop"], "", 0)


def test_a_message_that_cannot_be_read_ends_the_process_and_says_so() -> None:
    with listening() as (manager, process):
        manager.sendall(b"\x01\x00\x00\x00\xff")
        said, trouble = process.communicate(timeout=TIMEOUT_S)
        assert (said, process.returncode) == ("", 1)
        assert trouble.startswith("The manager sent a message that cannot be read: ")
