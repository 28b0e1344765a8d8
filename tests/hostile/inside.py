"""An action that attacks everything a session shares with others: its gate, its container, its manager.

It runs one attack after another and begins with the one in the file's last line, so that a program that was
ended during one of them is started again with the next.
"""

import contextlib
import ctypes
import json
import os
import socket
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import py_trees
from py_trees.common import Status

GATE = Path("/run/bt-studio")
DISK = Path(tempfile.gettempdir())
STINT_S = 8


def gates():
    """Returns every existing socket, and some possible ones."""
    found = [GATE / "gate.sock"]
    with contextlib.suppress(OSError):
        found += [path for path in GATE.rglob("*") if path.is_socket()]
    guessed = [GATE / os.urandom(16).hex() / "gate.sock" for _ in range(20)]
    return [str(path) for path in dict.fromkeys(found)] + [str(path) for path in guessed]


def flood_gates(until):
    """Opens connections that send nothing, half a line, too much, or a wrong token; as many as possible."""
    words = (
        b"",
        b'{"session": ',
        b"x" * 100_000,
        json.dumps({"session": "a", "token": "b"}).encode() + b"\n",
    )
    held: list[Any] = []
    while time.monotonic() < until:
        for number, path in enumerate(gates()):
            door = socket.socket(socket.AF_UNIX)
            door.setblocking(False)
            try:
                door.connect(path)
                door.send(words[(len(held) + number) % len(words)])
                held.append(door)
            except OSError:
                door.close()
        if len(held) > 3500:
            for door in held:
                door.close()
            held.clear()


def many_threads(until):
    while time.monotonic() < until:
        try:
            threading.Thread(target=time.sleep, args=(max(0, until - time.monotonic()),), daemon=True).start()
        except RuntimeError:
            time.sleep(0.01)


def many_processes(until):
    """Starts children that each start children."""
    while time.monotonic() < until:
        try:
            os.fork()
        except OSError:
            time.sleep(0.01)


def much_memory(until):
    hoard = []
    while time.monotonic() < until:
        hoard.append(os.urandom(16 << 20))


def much_disk(until):
    number = 0
    while time.monotonic() < until:
        number += 1
        try:
            (DISK / str(number)).write_bytes(bytes(8 << 20))
        except OSError:
            for path in DISK.glob("[0-9]*"):
                path.unlink()
    for path in DISK.glob("[0-9]*"):
        path.unlink()


def many_files(until):
    held = []
    while time.monotonic() < until:
        try:
            held.append(os.open("/dev/null", os.O_RDONLY))
            held.extend(os.pipe())
        except OSError:
            for descriptor in held:
                os.close(descriptor)
            held.clear()


def much_work(until):
    """Uses all processors, and makes system calls as fast as possible."""
    libc = ctypes.CDLL(None)

    def spin():
        while time.monotonic() < until:
            libc.sched_yield()

    workers = [threading.Thread(target=spin) for _ in range(8)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()


def much_said(until):
    """Prints lines for the viewer's console and for the log."""
    while time.monotonic() < until:
        print("x" * 5000)
        os.write(2, b"y" * 5000 + b"\n")


def managers_port(until):
    """Connects to the manager's own server, without its token."""
    held = []
    while time.monotonic() < until:
        try:
            held.append(socket.create_connection(("127.0.0.1", 7163), timeout=1))
            held[-1].sendall(b"GET /control HTTP/1.1\r\nX: ")
        except OSError:
            for door in held:
                door.close()
            held.clear()


KINDS = (
    flood_gates,
    many_files,
    much_work,
    much_said,
    managers_port,
    much_disk,
    many_threads,
    much_memory,
    many_processes,
)


class Forward(py_trees.behaviour.Behaviour):
    at_it: threading.Thread

    def __init__(self, name, ports=None):
        super().__init__(name)
        self.number = globals()["FIRST"]  # the last line of what is run sets it

    def update(self):
        """Continues to tick meanwhile, as a program does that wants to survive."""
        if not hasattr(self, "at_it") or not self.at_it.is_alive():
            kind = KINDS[self.number % len(KINDS)]
            self.number += 1
            print(f"TRIES {kind.__name__}")
            self.at_it = threading.Thread(target=kind, args=(time.monotonic() + STINT_S,), daemon=True)
            self.at_it.start()
        return Status.RUNNING
