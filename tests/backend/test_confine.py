"""The rights that our programs in containers give up, tried in processes that gave them up."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from backend.confine import confine

ROOT = Path(__file__).parents[2]
TRIES = """
import errno, json, os, socket, subprocess, sys, threading, ctypes
from backend.confine import confine
listener = socket.socket(socket.AF_UNIX)
listener.bind("listener")
listener.listen()
libc = ctypes.CDLL(None, use_errno=True)
confine(sys.argv[1])

def attempt(what):
    try:
        what()
    except (OSError, RuntimeError) as error:
        return errno.errorcode.get(getattr(error, "errno", 0), "RuntimeError")
    return ""

def call(number):
    ctypes.set_errno(0)
    return errno.errorcode[ctypes.get_errno()] if libc.syscall(number, 0, 0, 0, 0, 0, 0) < 0 else ""

def fork():
    if os.fork() == 0:
        os._exit(0)

def thread():
    started = threading.Thread(target=int)
    started.start()
    started.join()

# By their numbers on x86-64: io_uring, ptrace, process_vm_readv, unshare, setns, mount, bpf …
NEVER = (425, 426, 427, 101, 310, 272, 308, 165, 321, 298, 323, 248, 304)
found = {
    "unix": attempt(lambda: socket.socket(socket.AF_UNIX).close()),
    "inet": attempt(lambda: socket.socket(socket.AF_INET).close()),
    "netlink": attempt(lambda: socket.socket(16, socket.SOCK_RAW).close()),
    "vsock": attempt(lambda: socket.socket(40, socket.SOCK_STREAM).close()),
    "connect": attempt(lambda: socket.socket(socket.AF_UNIX).connect("listener")),
    "fork": attempt(fork),
    "program": attempt(lambda: subprocess.run(["/bin/true"], check=True)),
    "thread": attempt(thread),
    "never": sorted({call(number) for number in NEVER}),
}
print(json.dumps(found))
"""
REFUSED = "EPERM"


@pytest.mark.parametrize(
    ("role", "refused"),
    [
        ("gate", {"inet", "netlink", "connect", "fork", "program", "thread"}),
        ("keeper", {"inet", "netlink", "program"}),
        ("web", set()),
    ],
)
def test_each_role_gives_up_what_it_never_needs(role, refused, tmp_path):
    command = [sys.executable, "-W", "ignore", "-c", TRIES, role]
    environment = {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found.pop("vsock") == REFUSED
    assert found.pop("never") == [REFUSED]
    assert {name for name, error in found.items() if error} == refused


def test_a_program_becomes_a_confined_one():
    command = [sys.executable, "-m", "backend.confine", "web", "grep", "Seccomp:", "/proc/self/status"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["Seccomp:", "2"]


def test_a_machine_without_such_a_filter_is_named(monkeypatch):
    monkeypatch.setattr("platform.machine", lambda: "riscv64")
    with pytest.raises(OSError, match="riscv64"):
        confine("web")
