"""Descendants are found when they start, whole branches at a time; those of a run end with it."""

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


def test_what_a_run_starts_ends_with_it_and_nothing_else():
    script = """if True:
        import os, subprocess, sys
        from executor.supervision.descendants import RunChildren, descendants
        before = subprocess.Popen(["sleep", "600"])
        children = RunChildren()
        subprocess.Popen(["sleep", "600"])
        subprocess.run("sleep 600 >/dev/null & setsid sleep 600 >/dev/null &", shell=True)
        assert len(descendants(os.getpid())) == 4
        children.end()
        children.end()
        assert descendants(os.getpid()) == [before.pid]
        before.kill()
    """
    subprocess.run([sys.executable, "-c", script], check=True)
