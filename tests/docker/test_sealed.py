"""Sealed runs in containers of a real engine: they have their outcomes, and reach nothing.

The image is empty, and this machine's libraries are mounted into it, so nothing has to be built. `session`
has what the keeper's plan gives; `pod` has the engine's own filter of system calls, as pods have the
`RuntimeDefault` of their engine.
"""

from __future__ import annotations

import io
import json
import sys
import tarfile
from typing import TYPE_CHECKING

import pytest

from backend.sessions.keeper.plan import Plan, seccomp_profile
from tests.docker.engine import engine
from tests.executor.evaluation.projects import write
from tests.executor.evaluation.sealed.test_confine import ALG, CELLS, NETLINK, PACKET, ROOT, UNIX, VSOCK
from tests.executor.evaluation.sealed.test_run import FAULTS, HEAD, WAITS

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = [pytest.mark.timeout(600)]
LINKS = {"bin": "usr/bin", "lib": "usr/lib", "lib64": "usr/lib64", "sbin": "usr/sbin"}
FOLDERS = ("usr", "etc", "tmp", "dev", "proc", "sys", "run")


def empty_image() -> bytes:
    made = io.BytesIO()
    with tarfile.open(fileobj=made, mode="w") as archive:
        for name in FOLDERS:
            folder = tarfile.TarInfo(name)
            folder.type, folder.mode = tarfile.DIRTYPE, 0o1777 if name == "tmp" else 0o755
            archive.addfile(folder)
        for name, target in LINKS.items():
            link = tarfile.TarInfo(name)
            link.type, link.linkname = tarfile.SYMTYPE, target
            archive.addfile(link)
    return made.getvalue()


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sealed")
    with engine(folder) as found:
        (folder / "image.tar").write_bytes(empty_image())
        found.run("import", str(folder / "image.tar"), "bt-studio-bare")
        yield found


@pytest.fixture(params=["session", "pod"])
def start(request, running, tmp_path):
    """Runs a program of this checkout in a container with the settings of the keeper's plan."""
    made = Plan("bt-studio-bare", "/nowhere", "stack").container("id", "token", 1, "door")
    host = made["HostConfig"]
    profile = tmp_path / "seccomp.json"
    profile.write_text(seccomp_profile())
    options = [
        *("--network", host["NetworkMode"], "--ipc", host["IpcMode"], "--user", made["User"], "--read-only"),
        *(word for name in host["CapDrop"] for word in ("--cap-drop", name)),
        *("--security-opt", "no-new-privileges:true", "--pids-limit", str(host["PidsLimit"])),
        *(("--security-opt", f"seccomp={profile}") if request.param == "session" else ()),
        *(word for path, how in host["Tmpfs"].items() for word in ("--tmpfs", f"{path}:{how}")),
        *("--shm-size", str(host["ShmSize"]), "--memory", str(host["Memory"]), "--workdir", str(ROOT)),
        *("--env", "HOME=/tmp", "--env", "PYTHONDONTWRITEBYTECODE=1"),
    ]
    for folder in ("/usr", "/etc", str(ROOT), sys.prefix, sys.base_prefix):
        options += ["--volume", f"{folder}:{folder}:ro"]

    def started(*program: str, shown: Path | None = None, **more: object):
        seen = ["--volume", f"{shown}:/shown:ro"] if shown else []
        command = ["run", "--rm", "-i", *options, *seen, "bt-studio-bare", sys.executable, *program]
        return running.run(*command, **more)

    return started


def test_a_sealed_run_has_the_outcome_of_an_unsealed_one(start, tmp_path):
    folder = write(
        tmp_path / "project", f"{HEAD}{FAULTS}judge: {{success: [{{never: collision}}]}}\n", action=WAITS
    )
    jobs = "".join(
        json.dumps({"folder": "/shown", "seed": 1, "sealed": sealed}) + "\n" for sealed in (True, False)
    )
    done = start("-m", "tests.executor.evaluation.cells", shown=folder, input=jobs)
    sealed, unsealed = (line for line in done.stdout.splitlines() if line.startswith("{"))
    assert sealed == unsealed
    assert json.loads(sealed)["seen"]


def test_nothing_is_reached(start):
    families = map(str, (VSOCK, ALG, PACKET, UNIX, NETLINK))
    done = start("-m", "tests.executor.evaluation.sealed.outside", "sealed", *families)
    found = json.loads(done.stdout)
    assert [row for row, holds in CELLS.items() if not holds(found)] == [], found
    assert (found["sockets"], found["niceness"]) == ([], 0)
