"""Namespaces of a sealed process: how it ends, what is its own, and what it does where they are refused."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from executor.evaluation.sealed.namespaces import FOLDER_BYTES
from tests.executor.evaluation.sealed.launchers import LAUNCHERS, STARTED, WITHOUT_MOUNTS

ROOT = Path(__file__).parents[4]
ENDS = """
import os, signal, sys
from pathlib import Path
from executor.evaluation.sealed.confine import free_uid
from executor.evaluation.sealed.namespaces import continue_inside, separate
apart = separate([], Path(sys.argv[1]), free_uid())
assert apart.pids, apart
continue_inside()
assert os.getpid() == 2 and os.getppid() == 0
import threading
threading.Thread(target=int).start()
END
"""
APART = """
import json, os, sys, tempfile
from pathlib import Path
from executor.evaluation.sealed.confine import free_uid
from executor.evaluation.sealed.namespaces import separate
with tempfile.TemporaryDirectory() as name:
    (Path(name) / "before").touch()
    if os.fork() == 0:
        apart = separate([], Path(name), free_uid())
        found = os.statvfs(name)
        size, is_read_only = found.f_blocks * found.f_frsize, os.statvfs("/usr").f_flag & 1
        print(json.dumps([*apart[:3], size, os.listdir(name), is_read_only]), flush=True)
        os._exit(0)
    os.wait()
"""


def run_as(launcher, code, *arguments):
    return subprocess.run(
        [
            *(sys.executable, "-m", "tests.executor.evaluation.sealed.launchers", launcher),
            *(sys.executable, "-c", code, *arguments),
        ],
        cwd=ROOT,
        check=False,
        capture_output=True,
        text=True,
        timeout=60,
    )


@pytest.mark.parametrize(
    ("end", "status"),
    [
        ("os._exit(7)", 7),
        ("os._exit(0)", 0),
        ("os.kill(os.getpid(), signal.SIGKILL)", -signal.SIGKILL),
        ("os.kill(os.getpid(), signal.SIGTERM)", -signal.SIGTERM),
        ("os.abort()", -signal.SIGABRT),
    ],
)
def test_the_process_ends_as_the_one_inside_does(end, status, tmp_path):
    done = run_as(LAUNCHERS[0], ENDS.replace("END", end), tmp_path)
    assert done.returncode == status, done.stderr


@pytest.mark.parametrize("launcher", STARTED)
def test_each_launcher_gives_what_it_can(launcher):
    done = run_as(launcher, APART)
    assert done.returncode == 0, done.stderr
    spaces, pids, users, size, names, is_read_only = json.loads(done.stdout)
    if launcher in {"root", "user"}:
        assert (spaces, pids, users, size, names, is_read_only) == (True, True, True, FOLDER_BYTES, [], 1)
    else:
        own = launcher == WITHOUT_MOUNTS
        assert (spaces, pids, users, names) == (False, own, own, ["before"])
