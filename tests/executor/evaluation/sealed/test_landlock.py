"""Landlock alone: what may be opened, read and written afterwards."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from executor.evaluation.sealed.landlock import landlock_version

ROOT = Path(__file__).parents[4]
CODE = """
import json, os, sys
from pathlib import Path
from executor.evaluation.sealed.landlock import restrict_files
from executor.supervision import landlock
landlock.landlock_version = lambda real=landlock.landlock_version: min(real(), int(sys.argv[3]))
readable, writable = Path(sys.argv[1]), Path(sys.argv[2])
import ctypes
ctypes.CDLL(None).prctl(38, 1, 0, 0, 0)
restrict_files([readable, Path("/nothing here")], [writable])

def may(attempt):
    try:
        attempt()
    except OSError:
        return False
    return True

print(json.dumps([
    may(lambda: (readable / "a").read_text()),
    may(lambda: (readable / "a").write_text("x")),
    may(lambda: (readable / "b").touch()),
    may(lambda: (writable / "a").write_text("x")),
    may(lambda: os.listdir(readable.parent)),
    may(lambda: Path("/dev/null").write_text("x")),
    may(lambda: (writable / "a").read_text()),
]))
"""


@pytest.mark.parametrize("version", [1, 2, 3, 4, 5, 99])
def test_files_are_those_of_the_lists_by_every_version_of_landlock(version, tmp_path):
    readable, writable = tmp_path / "readable", tmp_path / "writable"
    for folder in (readable, writable):
        folder.mkdir()
    (readable / "a").write_text("a")
    done = subprocess.run(
        [sys.executable, "-c", CODE, readable, writable, str(version)],
        cwd=ROOT,
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == [True, False, False, True, False, True, True]


def test_a_kernel_that_refuses_is_said():
    assert landlock_version() >= 1
    code = """import os, resource
from executor.evaluation.sealed.landlock import restrict_files
resource.setrlimit(resource.RLIMIT_NOFILE, (3, 3))  # there is no descriptor left for the rules
restrict_files([], [])
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False, capture_output=True, text=True)
    assert "SealError: Landlock refuses" in done.stderr
