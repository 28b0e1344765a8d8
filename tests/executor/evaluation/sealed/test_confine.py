"""Sealing a process: what it may still do, and what it may not.

`CELLS` has the rows of the table *what a sealed tree cannot do* in `docs/explanation/sealed-runs.md`.
"""

from __future__ import annotations

import functools
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from executor.evaluation.sealed import confine
from executor.evaluation.sealed.confine import SealError, free_uid, readable_folders, require_seal
from tests.executor.evaluation.sealed.launchers import STARTED

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).parents[4]
VSOCK, ALG, PACKET, UNIX, NETLINK = 40, 38, 17, 1, 16
DEEDS = (
    "read the judge's files",
    "change files outside",
    "look into other processes",
    "signal other processes",
    "set limits or priorities of others",
    "reach Unix sockets",
    "reach others by IP",
    "make sockets of other families",
    "reach memory and queues of others",
    "make other namespaces, traces or rings",
)


def _is_refused(deed: str, found: dict[str, Any]) -> bool:
    return deed not in found["look"]


CELLS: dict[str, Callable[[dict[str, Any]], bool]] = {
    **{name: functools.partial(_is_refused, name) for name in DEEDS},
    "leave a note for another run": lambda found: found["find"] == [],
    "write without end": lambda found: found["fill"] in (found["most bytes"], WROTE),
    "start processes without end": lambda found: found["multiply"] == GREW or found["multiply"] < 256,
    "outlive its run": lambda found: (
        not any(count for name, count in found.items() if name.startswith("left by"))
    ),
}
WROTE = "the actions of the run wrote more than they may"
GREW = "the run started more processes than it may"
PLACES = {"shared memory", "System V", "queues", "keys", "times", "modes"}
CODE = """
import json, os, socket, sys
from pathlib import Path
from executor.evaluation.sealed.confine import free_uid, seal
scratch, hidden = Path(sys.argv[1]), Path(sys.argv[2])
uid = free_uid() if sys.argv[3] == "own" else None
if uid is not None:
    os.chown(scratch, uid, uid)
before, outside = os.getuid(), os.getppid()
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
    "signal": refused(lambda: os.kill(outside, 0)),
    "mount": refused(lambda: os.chroot(scratch)),
    "write": refused(lambda: Path(json.__file__).write_text("")),
    "shared": not refused(lambda: Path("/dev/shm/bt_studio_seal").write_text("x")),
}))
"""


@pytest.mark.parametrize("kind", ["own", "same"])
def test_a_sealed_process_reads_libraries_and_its_own_folder_alone(kind, tmp_path):
    (tmp_path / "scratch").mkdir()
    for folder in (tmp_path, *tmp_path.parents):
        if folder.name.startswith(("pytest-", "popen-")) or folder == tmp_path:  # pytest's own
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


# --- the table ---


@functools.cache
def found_by(launcher: str, how: str = "sealed") -> dict:
    """Returns what processes have reached that a launcher starts."""
    families = [VSOCK, ALG, PACKET, UNIX, *([] if launcher in {"root", "user"} else [NETLINK])]
    done = subprocess.run(
        [
            *(sys.executable, "-m", "tests.executor.evaluation.sealed.launchers", launcher),
            *(sys.executable, "-m", "tests.executor.evaluation.sealed.outside", how),
            *map(str, families),
        ],
        cwd=ROOT,
        check=False,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("launcher", STARTED)
@pytest.mark.parametrize("row", CELLS)
def test_what_a_sealed_tree_cannot_do(row, launcher):
    found = found_by(launcher)
    assert CELLS[row](found), found


@pytest.mark.parametrize("launcher", STARTED)
def test_nothing_comes_to_the_sockets_and_processes_outside(launcher):
    found = found_by(launcher)
    assert (found["sockets"], found["niceness"]) == ([], 0)


def test_without_a_seal_all_of_it_succeeds():
    found = found_by("user", "open")
    assert {*DEEDS} - {"make other namespaces, traces or rings", "make sockets of other families"} <= {
        *found["look"]
    }
    assert PLACES - {"queues", "keys"} <= {*found["find"]}
    assert found["sockets"] == ["stream", "datagram", "abstract", "tcp", "udp"]
    assert (found["fill"], found["multiply"]) == (WROTE, GREW)


def test_a_kernel_without_filters_is_said(monkeypatch):
    monkeypatch.setattr("platform.machine", lambda: "riscv64")
    with pytest.raises(SealError, match=r"it needs filters of system calls .* on x86_64 or aarch64"):
        require_seal()
