"""Descendants of this process are found when they start, whole branches at a time, and no other process."""

import os
import subprocess
import sys

import psutil

from executor.supervision.descendants import FORGET_EVERY, Descendants

BRANCH = """
import subprocess, sys
child = subprocess.Popen([sys.executable, "-c", "input()"], stdin=sys.stdin)
print(child.pid, flush=True)
child.wait()
"""


def test_a_branch_is_found_when_it_grows_and_gone_when_it_ended():
    descendants = Descendants()
    before = {process.pid for process in descendants.look()}
    with subprocess.Popen(
        [sys.executable, "-c", BRANCH], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as parent:
        child = int(parent.stdout.readline())
        for _ in range(FORGET_EVERY + 1):  # with and without a full scan
            found = [process.pid for process in descendants.look()]
            assert set(found) - before == {parent.pid, child}
            assert found.index(parent.pid) < found.index(child)
        assert not {os.getpid(), os.getppid()} & set(found)
        parent.communicate("\n")
    assert not {parent.pid, child} & {process.pid for process in descendants.look()}


def test_it_agrees_with_a_full_scan():
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as child:
        found = {process.pid for process in Descendants().look()}
        assert found == {process.pid for process in psutil.Process().children(recursive=True)}
        child.communicate(b"\n")
