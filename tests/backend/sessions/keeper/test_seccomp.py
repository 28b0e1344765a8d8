"""The system calls that a session's container may make: what leads out is refused, and a robot drives."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from backend.sessions.keeper.plan import seccomp_profile
from tests.executor.session_client import SessionClient, run_data

ROOT = Path(__file__).parents[4]
CONFINED = (sys.executable, "-m", "tests.backend.sessions.keeper.confined", sys.executable)
TRIES = """
import ctypes, errno, json, os, socket, subprocess, threading
libc = ctypes.CDLL(None, use_errno=True)

def family(number):
    try:
        socket.socket(number, socket.SOCK_STREAM if number != 16 else socket.SOCK_RAW).close()
    except OSError as error:
        return errno.errorcode[error.errno]
    return ""

def call(number, *arguments):
    ctypes.set_errno(0)
    return errno.errorcode[ctypes.get_errno()] if libc.syscall(number, *arguments) < 0 else ""

thread = threading.Thread(target=print)
thread.start()
thread.join()
found = {
    "child": subprocess.run(["/bin/true"]).returncode,
    "families": {name: family(number) for name, number in FAMILIES.items()},
    "calls": {name: call(number, 0, 0, 0, 0, 0, 0) for name, number in CALLS.items()},
}
print(json.dumps(found))
"""
FAMILIES = {"unix": 1, "inet": 2, "inet6": 10, "netlink": 16, "packet": 17, "alg": 38, "vsock": 40}
CALLS = {  # by their numbers on x86-64
    "io_uring_setup": 425,
    "io_uring_enter": 426,
    "io_uring_register": 427,
    "io_setup": 206,
    "ptrace": 101,
    "process_vm_readv": 310,
    "unshare": 272,
    "setns": 308,
    "mount": 165,
    "bpf": 321,
    "perf_event_open": 298,
    "userfaultfd": 323,
    "keyctl": 250,
    "add_key": 248,
    "kexec_load": 246,
    "open_by_handle_at": 304,
}


def test_nothing_that_is_refused_is_among_what_is_allowed():
    rules = json.loads(seccomp_profile())["syscalls"]
    allowed = {name for rule in rules if rule["action"] == "SCMP_ACT_ALLOW" for name in rule["names"]}
    assert not allowed & CALLS.keys()
    assert {arg["value"] for rule in rules if rule["names"] == ["socket"] for arg in rule["args"]} == {
        1,
        2,
        10,
        16,
    }
    assert not any(name.startswith("io_uring") for name in allowed)


def test_what_leads_out_of_a_session_is_refused():
    source = f"FAMILIES, CALLS = {FAMILIES}, {CALLS}\n{TRIES}"
    done = subprocess.run((*CONFINED, "-c", source), cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["child"] == 0
    refused = {name for name, error in found["families"].items() if error == "EPERM"}
    assert refused == {"packet", "alg", "vsock"}
    assert [found["families"][name] for name in ("unix", "inet", "netlink")] == ["", "", ""]
    assert set(found["calls"].values()) == {"EPERM"}, found["calls"]


@pytest.mark.simulation
async def test_a_robot_drives_under_the_profile():
    import asyncio

    reader, writer = os.pipe()
    process = await asyncio.create_subprocess_exec(
        *(*CONFINED, "-m", "executor.manager", "--port", "0", "--token-env", "TOKEN"),
        *("--ready-fd", str(writer)),
        pass_fds=[writer],
        cwd=ROOT,
        env={**os.environ, "TOKEN": "secret"},
    )
    os.close(writer)
    try:
        with os.fdopen(reader) as ready:
            port = json.loads(await asyncio.to_thread(ready.readline))["port"]
        client = await SessionClient(port).open()
        for stream in ("poses", "scan", "camera"):
            await client.ask("subscribe", {"stream": stream})
        assert await client.ask("run", run_data()) == "ack"
        await client.event("tick", lambda data: data["n"] > 5)
        await client.until(lambda: {type(frame).__name__ for _, frame in client.frames} >= {"Poses", "Scan"})
        await client.close()
    finally:
        with contextlib.suppress(ProcessLookupError):
            process.terminate()
        await process.wait()
