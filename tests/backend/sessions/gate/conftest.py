"""A gate in its own process, and functions that act as the keeper and as sessions."""

from __future__ import annotations

import json
import resource
import signal
import socket
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

import pytest

from backend.sessions.gate.client import Door
from backend.sessions.gate.errors import GateError
from backend.sessions.gate.probe import probe
from tests.e2e.server import wait_until

ROOT = Path(__file__).parents[4]
TOKEN = "t" * 64


class Gate:
    """The program, with its folders below a short path (that of a socket holds 107 bytes)."""

    def __init__(self, folder):
        self.doors = folder / "doors"
        self.control = folder / "control" / "gate.sock"
        self._kept = ExitStack()
        self.process = None

    @property
    def _environment(self):
        return {"BT_STUDIO_GATE_FOLDER": str(self.doors), "BT_STUDIO_GATE_CONTROL": str(self.control)}

    def program(self, *arguments, **options):
        command = [sys.executable, "-m", "backend.sessions.gate", *arguments]
        return subprocess.Popen(command, cwd=ROOT, env=self._environment, **options)

    def start(self, *, descriptors=1024):
        """Starts it with so many descriptors."""
        self.process = self.program(
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (descriptors, descriptors))
        )
        wait_until(self.answers, "the gate answers")

    def check(self):
        """The exit status of the container's health check."""
        return self.program("--check", stderr=subprocess.DEVNULL).wait(60)

    def answers(self):
        try:
            probe(self.control, self.doors)
        except (OSError, GateError):
            return False
        return True

    def open_door(self, session="s", timeout_s=60):
        """Acts as the keeper for a session; returns the door, and the socket that comes through it."""
        ours, handed = (self._kept.enter_context(one) for one in socket.socketpair())
        return self._kept.enter_context(Door(self.control, handed, session, TOKEN).open(timeout_s)), ours

    def entrance(self, door):
        return self.doors / door.path

    def connect(self, path, count=1):
        """Opens connections that send nothing."""
        made = []
        for _ in range(count):
            one = self._kept.enter_context(socket.socket(socket.AF_UNIX))
            one.connect(str(path))  # waits if there are many connections
            one.settimeout(60)
            made.append(one)
        return made

    def close(self):
        self._kept.close()
        if self.process is not None and self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.terminate()
            assert self.process.wait(60) == 0


def show(caller, *, session="s", token=TOKEN):
    """Sends a token at a door."""
    caller.sendall(json.dumps({"session": session, "token": token}).encode() + b"\n")


def fetch(caller):
    """Returns the words of the gate's answer, and whether it passed a socket."""
    words, descriptors, _, _ = socket.recv_fds(caller, 64, 1)
    for descriptor in descriptors:
        socket.socket(fileno=descriptor).close()
    return words, len(descriptors)


@pytest.fixture
def stopped_gate():
    with tempfile.TemporaryDirectory() as name:
        made = Gate(Path(name))
        try:
            yield made
        finally:
            made.close()


@pytest.fixture
def gate(stopped_gate):
    stopped_gate.start()
    return stopped_gate
