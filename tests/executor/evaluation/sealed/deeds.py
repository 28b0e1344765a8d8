"""Harmless attempts at the things that a sealed tree cannot do, from a process that is sealed first.

`python deeds.py KIND WORLD SCRATCH sealed|open`: WORLD is JSON with the names of what `outside` has made. It
prints the names of the attempts that succeeded. `outside` finds by itself what has come to it.
"""

from __future__ import annotations

import ctypes
import functools
import json
import mmap
import os
import resource
import signal
import socket
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

from executor.evaluation.sealed.confine import free_uid, seal
from executor.evaluation.sealed.system_calls import NUMBERS

SHARED = Path("/dev/shm")  # noqa: S108 - what runs might share
MACHINE = ["x86_64", "aarch64"].index(os.uname().machine)
MOST = 448 << 20
CREATE = 0o1000 | 0o666
KEY = 0x42545354
USER_KEYS = -4


class RefusedError(Exception):
    """A call has failed."""


def call(name: str, *arguments: Any) -> int:
    given = [each if isinstance(each, bytes | ctypes.Array) else ctypes.c_long(each) for each in arguments]
    result = int(ctypes.CDLL(None, use_errno=True).syscall(NUMBERS[name][MACHINE], *given))
    if result < 0:
        raise RefusedError
    return result


def family(number: int) -> None:
    socket.socket(number, socket.SOCK_RAW if number == 16 else socket.SOCK_STREAM).close()


def send(kind: int, where: Any, way: int = socket.AF_UNIX) -> None:
    with socket.socket(way, kind) as made:
        made.settimeout(1.0)
        made.connect(where)
        made.send(b"x")


def trace(pid: int) -> None:
    call("ptrace", 0x4206, pid, 0, 0)
    os.kill(pid, signal.SIGSTOP)
    os.waitpid(pid, 0x40000000)
    call("ptrace", 17, pid, 0, 0)
    os.kill(pid, signal.SIGCONT)


def deeds(w: dict[str, Any]) -> dict[str, list[Any]]:
    """Returns the attempts by row of the table; a row fails if one of them succeeds."""
    judge, hidden = w["judge"], Path(w["hidden"])
    return {
        "read the judge's files": [hidden.read_bytes, lambda: [*hidden.parent.iterdir()]],
        "change files outside": [
            lambda: (hidden.parent / "left").write_text("x"),
            lambda: hidden.chmod(0o666),
            lambda: os.utime(hidden, (1, 1)),
            lambda: os.truncate(hidden, 1),
            lambda: hidden.rename(hidden.parent / "moved"),
        ],
        "look into other processes": [
            lambda: [*Path("/proc").iterdir()],
            lambda: Path(f"/proc/{judge}/cmdline").read_bytes(),
            functools.partial(trace, judge),
            lambda: call("process_vm_readv", judge, 0, 0, 0, 0, 0),
        ],
        "signal other processes": [
            lambda: os.kill(judge, 0),
            lambda: signal.pidfd_send_signal(os.pidfd_open(judge), 0),
            lambda: call("tgkill", judge, judge, 0),
        ],
        "set limits or priorities of others": [
            lambda: resource.prlimit(judge, resource.RLIMIT_CORE, (0, 0)),
            lambda: os.setpriority(os.PRIO_PROCESS, judge, 10),
            lambda: os.sched_setaffinity(judge, os.sched_getaffinity(0)),
            lambda: os.sched_setscheduler(judge, os.SCHED_BATCH, os.sched_param(0)),
            lambda: call("ioprio_set", 1, judge, 2 << 13 | 7),
            # Unsealed, this would be no harmless attempt: it concerns all processes of the user.
            *([functools.partial(os.setpriority, os.PRIO_USER, 0, 10)] if w["sealed"] else []),
        ],
        "reach Unix sockets": [
            lambda: send(socket.SOCK_STREAM, w["stream"]),
            lambda: send(socket.SOCK_DGRAM, w["datagram"]),
            lambda: send(socket.SOCK_STREAM, "\0" + w["abstract"]),
        ],
        "reach others by IP": [
            lambda: send(socket.SOCK_STREAM, ("127.0.0.1", w["tcp"]), socket.AF_INET),
            # Nobody answers to a datagram: `outside` says whether it has arrived.
            lambda: send(socket.SOCK_DGRAM, ("127.0.0.1", w["udp"]), socket.AF_INET) or 1 / 0,
        ],
        "make sockets of other families": [functools.partial(family, number) for number in w["families"]],
        "reach memory and queues of others": [
            lambda: call("shmat", w["shm"], 0, 0),
            lambda: call("shmget", w["key"], 1, 0),
            lambda: call("msgsnd", w["queue"], ctypes.create_string_buffer(b"\1" + bytes(15)), 1, 0o4000),
            lambda: call("semget", w["key"], 1, 0),
            (SHARED / w["shared"]).read_bytes,
        ],
        "make other namespaces, traces or rings": [
            lambda: call("unshare", 0x10000000),
            lambda: call("io_uring_setup", 1, ctypes.create_string_buffer(120)),
        ],
    }


def notes(w: dict[str, Any]) -> dict[str, tuple[Any, Any]]:
    """Returns the places of notes: how one is left, and how it is found."""
    beside = Path(w["scratch"]).parent / "bt_studio_note"
    name = ctypes.create_string_buffer(b"bt_studio_note")
    user, text = ctypes.create_string_buffer(b"user"), ctypes.create_string_buffer(b"x")
    free = Path(w["free"])
    return {
        "shared memory": ((SHARED / "bt_studio_note").touch, (SHARED / "bt_studio_note").stat),
        "System V": (lambda: call("shmget", KEY, 1, CREATE), lambda: call("shmget", KEY, 1, 0)),
        "queues": (
            lambda: call("mq_open", name, os.O_CREAT | os.O_RDWR, 0o666, 0),
            lambda: call("mq_open", name, os.O_RDONLY, 0, 0),
        ),
        "keys": (
            lambda: call("add_key", user, name, text, 1, USER_KEYS),
            lambda: call("keyctl", 10, USER_KEYS, user, name, 0),
        ),
        "files": (beside.touch, beside.stat),
        "times": (lambda: os.utime(free, (1, 1)), lambda: free.stat().st_mtime == 1 or 1 / 0),
        "modes": (lambda: free.chmod(0o601), lambda: free.stat().st_mode & 0o777 == 0o601 or 1 / 0),
    }


def forget() -> None:
    """Removes the notes that outlive a process."""
    for each in (
        (SHARED / "bt_studio_note").unlink,
        lambda: call("shmctl", call("shmget", KEY, 1, 0), 0, 0),
        lambda: call("mq_unlink", ctypes.create_string_buffer(b"bt_studio_note")),
    ):
        succeeds(each)


def succeeds(attempt: Any) -> bool:
    with suppress(OSError, RefusedError, ZeroDivisionError, ValueError):
        attempt()
        return True
    return False


def fill(scratch: Path) -> int:
    """Writes until it is refused; returns the bytes."""
    done, piece = 0, mmap.mmap(-1, 1 << 20)
    with suppress(OSError):
        for number in range(MOST >> 24):
            with (scratch / str(number)).open("wb", buffering=0) as file:
                for _ in range(16):
                    done += file.write(piece)
    return done


def multiply() -> int:
    """Starts processes until it is refused; returns how many."""
    done = 0
    with suppress(OSError):
        while done < 600:
            if os.fork() == 0:
                signal.pause()
            done += 1
    return done


def attempt(kind: str, w: dict[str, Any], scratch: Path) -> Any:
    """Does what the process is for."""
    match kind:
        case "look":
            return [name for name, row in deeds(w).items() if sum(map(succeeds, row))]
        case "leave":
            if os.fork() == 0:
                os.setsid()
                Path(w["scratch"], "left").touch()
                signal.pause()
            return [name for name, (leave, _) in notes(w).items() if succeeds(leave)]
        case "find":
            return [name for name, (_, find) in notes(w).items() if succeeds(find)]
        case "fill":
            return fill(scratch)
        case _:
            return multiply()


def main() -> None:
    kind, world, scratch, how = sys.argv[1:]
    w = json.loads(world) | {"scratch": scratch, "sealed": how == "sealed"}
    if how == "sealed":
        seal(Path(scratch), uid=free_uid())
    os.write(1, json.dumps(attempt(kind, w, Path(scratch))).encode())
    os._exit(0)


if __name__ == "__main__":
    main()
