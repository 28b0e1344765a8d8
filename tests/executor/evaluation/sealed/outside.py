"""`python -m tests.executor.evaluation.sealed.outside sealed|open`: runs all of `deeds` as the pool does.

It makes what a sealed process must not reach, and prints, as JSON, what was reached by row of the table.
"""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any

from executor.evaluation.outcome import Outcome
from executor.evaluation.pool.accounting import SCRATCH_PREFIX
from executor.evaluation.pool.worker import Job, Limits, run_apart
from executor.evaluation.sealed.confine import free_uid
from executor.evaluation.sealed.namespaces import FOLDER_BYTES
from executor.supervision.confine import adopt_orphans
from executor.supervision.descendants import descendants
from tests.executor.evaluation.sealed.deeds import CREATE, call, forget

ROOT = Path(__file__).parents[4]
KEY = 0x42545355
KINDS = ("look", "leave", "find", "fill", "multiply")
INSIDE = (sys.executable, "-P", Path(__file__).with_name("deeds.py"))


class World:
    """Files, sockets and memory outside of the sealed processes, open to every user of the machine."""

    def __init__(self, stack: ExitStack) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="bt-outside-"))
        stack.callback(shutil.rmtree, self.folder, ignore_errors=True)
        self.folder.chmod(0o755)
        (self.folder / "hidden").write_text("secret")
        (self.folder / "free").write_text("free")
        self.sockets = {
            "stream": self._socket(stack, socket.SOCK_STREAM, str(self.folder / "stream")),
            "datagram": self._socket(stack, socket.SOCK_DGRAM, str(self.folder / "datagram")),
            "abstract": self._socket(stack, socket.SOCK_STREAM, f"\0bt-outside-{os.getpid()}"),
            "tcp": self._socket(stack, socket.SOCK_STREAM, ("127.0.0.1", 0)),
            "udp": self._socket(stack, socket.SOCK_DGRAM, ("127.0.0.1", 0)),
        }
        shared = Path("/dev/shm", f"bt-outside-{os.getpid()}")  # noqa: S108 - what runs might share
        shared.write_text("secret")
        stack.callback(shared.unlink)
        self.shared = shared.name
        key = KEY + os.getpid()
        self.key = key
        self.shm = call("shmget", key, 1, CREATE)
        stack.callback(call, "shmctl", self.shm, 0, 0)
        self.queue = call("msgget", key, CREATE)
        stack.callback(call, "msgctl", self.queue, 0, 0)
        semaphores = call("semget", key, 1, CREATE)
        stack.callback(call, "semctl", semaphores, 0, 0, 0)

    def _socket(self, stack: ExitStack, kind: int, where: Any) -> socket.socket:
        made = stack.enter_context(
            socket.socket(socket.AF_INET if isinstance(where, tuple) else socket.AF_UNIX, kind)
        )
        made.bind(where)
        made.setblocking(False)
        if kind == socket.SOCK_STREAM:
            made.listen()
        return made

    def names(self, families: list[int]) -> dict[str, Any]:
        return {
            "judge": os.getpid(),
            "hidden": str(self.folder / "hidden"),
            "free": str(self.folder / "free"),
            "stream": str(self.folder / "stream"),
            "datagram": str(self.folder / "datagram"),
            "abstract": self.sockets["abstract"].getsockname()[1:].decode(),
            "tcp": self.sockets["tcp"].getsockname()[1],
            "udp": self.sockets["udp"].getsockname()[1],
            "shared": self.shared,
            "shm": self.shm,
            "queue": self.queue,
            "key": self.key,
            "families": families,
        }

    def reached(self) -> list[str]:
        """Returns the sockets to which something has come."""
        found = []
        for name, made in self.sockets.items():
            with suppress(BlockingIOError):
                made.recv(1) if made.type == socket.SOCK_DGRAM else made.accept()[0].close()
                found.append(name)
        return found


def run_one(kind: str, world: World, how: str, families: list[int]) -> Any:
    """Returns what a sealed process of this kind printed; what the pool says, if it ended the run."""

    def cell(seed: int) -> Outcome:
        scratch = Path(tempfile.mkdtemp(prefix=SCRATCH_PREFIX))
        scratch.parent.chmod(0o711)
        uid = free_uid()
        if uid is not None:
            os.chown(scratch, uid, uid)
        with tempfile.TemporaryFile() as answer:  # no pipe: what a process leaves would hold it open
            code = subprocess.run(
                [*INSIDE, kind, json.dumps(world.names(families)), scratch, how],
                stdout=answer,
                stderr=answer,
                env={**os.environ, "PYTHONPATH": str(ROOT)},
                start_new_session=True,
                check=False,
            ).returncode
            answer.seek(0)
            return Outcome(seed, "success" if code == 0 else "error", answer.read().decode())

    found = run_apart(Job(0, Limits(60.0)), cell).outcome
    return json.loads(found.why) if found.outcome == "success" else found.why


def main() -> None:
    how, *families = sys.argv[1:]
    adopt_orphans()
    found: dict[str, Any] = {}
    with ExitStack() as stack:
        stack.callback(forget)
        forget()
        world = World(stack)
        for kind in KINDS:
            found[kind] = run_one(kind, world, how, [int(each) for each in families])
            found[f"left by {kind}"] = len(descendants(os.getpid()))
        found["sockets"] = world.reached()
        found["niceness"] = os.getpriority(os.PRIO_PROCESS, 0)
    found["most bytes"] = FOLDER_BYTES
    sys.stdout.write(json.dumps(found) + "\n")


if __name__ == "__main__":
    main()
