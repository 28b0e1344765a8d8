"""Sealing a process: what it may still do, and what it may not."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from executor.evaluation.sealed import confine
from executor.evaluation.sealed.confine import SealError, free_uid, readable_folders, require_seal

ROOT = Path(__file__).parents[4]
CODE = """
import json, os, socket, sys
from pathlib import Path
from executor.evaluation.sealed.confine import free_uid, seal
scratch, hidden = Path(sys.argv[1]), Path(sys.argv[2])
uid = free_uid() if sys.argv[3] == "own" else None
if uid is not None:
    os.chown(scratch, uid, uid)
before = os.getuid()
seal(scratch, uid=uid)

def refused(attempt):
    try:
        attempt()
    except OSError:
        return True
    return False

import cv2, numpy, rclpy  # the libraries can be read
(scratch / "own").write_text("x")
print(json.dumps({
    "own uid": os.getuid() != before,
    "reads": not refused(lambda: Path(json.__file__).read_bytes()),
    "hidden": refused(lambda: hidden.read_bytes()),
    "proc": refused(lambda: Path("/proc/self/status").read_bytes()),
    "signal": refused(lambda: os.kill(os.getppid(), 0)),
    "mount": refused(lambda: os.chroot(scratch)),
    "write": refused(lambda: Path(json.__file__).write_text("")),
    "shared": not refused(lambda: Path("/dev/shm/bt_studio_seal").write_text("x")),
}))
"""


@pytest.mark.parametrize("kind", ["own", "same"])
def test_a_sealed_process_reads_libraries_and_its_own_folder_alone(kind, tmp_path):
    (tmp_path / "scratch").mkdir()
    for folder in (tmp_path, *tmp_path.parents[:2]):
        folder.chmod(0o755)
    (tmp_path / "hidden").write_text("secret")
    done = subprocess.run(
        [sys.executable, "-c", CODE, tmp_path / "scratch", tmp_path / "hidden", kind],
        cwd=ROOT,
        check=False,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    is_root = os.getuid() == 0
    assert found.pop("own uid") is (is_root and kind == "own")
    assert all(found.values()), found
    assert not Path("/dev/shm/bt_studio_seal").exists() or not is_root  # noqa: S108 - its own is another one
    Path("/dev/shm/bt_studio_seal").unlink(missing_ok=True)  # noqa: S108 - as above


def test_a_kernel_without_landlock_is_said(monkeypatch):
    require_seal()
    monkeypatch.setattr(confine, "landlock_version", lambda: 0)
    with pytest.raises(SealError, match=r"cannot seal runs: its kernel has no Landlock \(Linux 5\.13"):
        require_seal()


def test_the_checkout_itself_is_not_readable():
    found = readable_folders()
    assert ROOT not in found
    assert ROOT / "executor" in found
    assert not any((ROOT / "examples").is_relative_to(path) for path in found)


def test_only_root_has_a_free_uid():
    assert (free_uid() is None) == (os.getuid() != 0)
