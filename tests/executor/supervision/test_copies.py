"""Copies of processes: who their parent is, what they share, and by what they are known."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import psutil

from executor.supervision.copies import MARK

ROOT = Path(__file__).parents[3]
PROGRAM = """
import json, os, socket, sys, time
from executor.supervision.confine import adopt_orphans, die_with_parent
from executor.supervision.copies import *
adopt_orphans()
die_with_parent()
file = open(sys.argv[1], "w+")
file.write("first"); file.flush()
udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM); udp.bind(("127.0.0.1", 0)); udp.setblocking(False)
memory = os.memfd_create("m"); os.write(memory, b"m")
read, write = os.pipe()
own = os.getpid()
middle = os.fork()
if middle == 0:
    between = fork_away()
    if between is None:
        mark = stand_alone()
        forked_copy(own)
        renew_files()
        name_process("renamed")
        file.write(" copy"); file.flush()
        found = {
            "parent": os.getppid() == own, "leader": os.getsid(0) == os.getpid(), "mark": mark,
            "seen": open("/proc/self/environ").read().count(mark), "environ": os.environ["BT_STUDIO_CHILD"],
            "position": file.tell(), "port": udp.getsockname()[1], "blocks": udp.getblocking(),
            "memory": os.fstat(memory).st_size, "out": os.readlink("/proc/self/fd/1"),
            "name": open("/proc/self/comm").read().strip(),
        }
        os.write(write, json.dumps(found).encode())
        time.sleep(600)
    os.waitpid(between, 0)
    os._exit(0)
os.waitpid(middle, 0)
found = json.loads(os.read(read, 4096))
found["copy"] = next(int(p) for p in os.popen(f"ps -o pid= --ppid {own}").read().split() if int(p) != 0)
found["after"] = file.tell()
print(json.dumps(found), flush=True)
os.kill(own, 9)
"""


def test_a_copy_stands_alone_and_ends_with_its_new_parent(tmp_path: Path) -> None:
    environment = {**os.environ, MARK: "f" * 16, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path / "file")],
        env=environment,
        stdout=subprocess.PIPE,
        check=False,
    )
    found = json.loads(done.stdout)
    assert found["parent"]
    assert found["leader"]
    assert found["seen"] == 1
    assert found["environ"] == found["mark"] != "f" * 16
    assert (found["position"], found["after"]) == (10, 5)  # each has its own place in the file
    assert found["port"] == 0
    assert not found["blocks"]
    assert found["memory"] == 1
    assert found["out"] == os.devnull
    assert found["name"] == "renamed"
    with_copy = psutil.Process(found["copy"]) if psutil.pid_exists(found["copy"]) else None
    assert with_copy is None or with_copy.wait(10) is None or not with_copy.is_running()
