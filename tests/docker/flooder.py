"""An action that searches for the doors of other sessions, and then floods one whose name it knows.

It prints its results as one line of JSON, and at each step the number of connections that it holds.
"""

import ctypes
import json
import os
import secrets
import socket
from pathlib import Path

import py_trees
from py_trees.common import Status

# The test appends its settings to the end of the file.
DOOR = ""
ROOT = Path("/run/bt-studio")
GUESSES = 5000
A_STEP = 250
IN_MODIFY = 2


def attempt(what):
    try:
        return f"reached: {what()}"
    except Exception as error:
        return f"refused: {type(error).__name__}"


def connect(path):
    with socket.socket(socket.AF_UNIX) as caller:
        caller.connect(str(path))
        return str(path)


def watch():
    """Watches the folder by inotify; returns a number, as ctypes gives it, or the error."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.inotify_add_watch(libc.inotify_init(), str(ROOT).encode(), IN_MODIFY) < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return "watched"


def own_doors():
    """Returns the doors that the command lines of this container name."""
    for folder in Path("/proc").glob("[0-9]*"):
        words = (folder / "cmdline").read_bytes().decode().split("\0")
        yield from (word for word in words if word.endswith("/gate.sock"))


def look():
    guesses = (ROOT / secrets.token_hex(16) / "gate.sock" for _ in range(GUESSES))
    return {
        "list": attempt(lambda: list(ROOT.iterdir())),
        "watch": attempt(watch),
        "write": attempt((ROOT / "mine").mkdir),
        "root": attempt(lambda: connect(ROOT / "gate.sock")),
        "own": sorted({attempt(lambda path=path: connect(path)) for path in own_doors()}),
        "guessed": sorted({attempt(lambda path=path: connect(path)) for path in guesses}),
        # The sockets of other containers are in other namespaces.
        "named": [
            line
            for line in Path("/proc/net/unix").read_text().splitlines()
            if "gate.sock" in line and DOOR not in line
        ],
        "control": Path("/run/bt-studio-control").exists(),
    }


class Forward(py_trees.behaviour.Behaviour):
    def __init__(self, name, ports=None):
        super().__init__(name)
        self.made = []

    def update(self):
        if not self.made:
            print("FOUND " + json.dumps(look()))
        for _ in range(A_STEP):
            caller = socket.socket(socket.AF_UNIX)
            caller.setblocking(False)
            try:
                caller.connect(str(ROOT / DOOR))
            except BlockingIOError:
                caller.close()
                break
            self.made.append(caller)
        del self.made[:-2000]  # the oldest are closed, since its own descriptors would run out
        print(f"FLOODED {len(self.made)}")
        return Status.RUNNING
