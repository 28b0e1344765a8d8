"""A child with all that it starts: its number is its own until its group was ended."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import psutil

from executor.tools.groups import Group
from tests.deadline import wait_until

FORKS = """
import os, sys, time
said = sys.stdin.buffer.read()
if os.fork() == 0:
    print(os.getpid(), len(said), flush=True)
    time.sleep(1000)
sys.exit(3)
"""


def unreaped(monkeypatch):
    """Whether the number of each group that is ended was still that of its child."""
    found, end = [], os.killpg

    def killpg(number, how):
        found.append(os.waitid(os.P_PID, number, os.WEXITED | os.WNOWAIT | os.WNOHANG) is not None)
        end(number, how)

    monkeypatch.setattr(os, "killpg", killpg)
    return found


async def test_what_a_child_has_left_ends_before_its_number_is_free(monkeypatch):
    was_its_own = unreaped(monkeypatch)
    group = Group([sys.executable, "-c", FORKS], folder="/", environment=dict(os.environ))
    out, _ = await group.outputs()
    await group.write(bytes(1_000_000))
    group.close_input()
    left, size = map(int, (await out.readline()).split())
    assert size == 1_000_000
    await group.exited()
    assert group.end() == 3
    assert was_its_own == [True]
    wait_until(lambda: not is_running(left), "what the child left is ended")


async def test_a_child_that_reads_nothing_is_ended_while_it_is_written_to():
    group = Group([sys.executable, "-c", "input()"], folder="/", environment=dict(os.environ))
    await group.outputs()
    assert group.end() == -signal.SIGKILL
    try:
        await group.write(b"x")
    except (OSError, ValueError):
        pass
    else:
        raise AssertionError


def is_running(pid):
    return Path(f"/proc/{pid}").exists() and psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
