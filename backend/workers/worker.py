"""A worker process, `python -m backend.workers.worker --fd N`: runs one job after the other.

It keeps no state except caches, has no access to the database or to secrets, and ends with the web server.
"""

from __future__ import annotations

import argparse
import gc
import os
import resource
import signal
import socket
import traceback
from typing import TYPE_CHECKING, Any

import msgspec

from backend.workers import frames
from backend.workers.jobs import JOBS, warm_up

if TYPE_CHECKING:
    from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> None:
    """Does jobs until the pool closes the socket."""
    parser = argparse.ArgumentParser(prog="python -m backend.workers.worker", description=__doc__)
    parser.add_argument("--fd", type=int, required=True)
    parser.add_argument("--memory-bytes", type=int, required=True)
    parser.add_argument("--deadline-s", type=float, required=True)
    parser.add_argument("--niceness", type=int, default=0)
    options = parser.parse_args(arguments)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server handles Ctrl+C
    resource.setrlimit(resource.RLIMIT_DATA, (options.memory_bytes, options.memory_bytes))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.nice(options.niceness)
    warm_up()
    gc.collect()
    gc.freeze()
    with socket.socket(fileno=options.fd) as connection:
        try:
            serve(connection, options.deadline_s)
        except MemoryError:
            os._exit(frames.OUT_OF_MEMORY)  # an orderly end may need memory, too


def serve(connection: socket.socket, deadline_s: float) -> None:
    """Answers messages until the connection ends."""
    try:
        while True:
            # The packed message is freed once it is unpacked: the largest project has 256 MB.
            message = msgspec.msgpack.decode(frames.receive(connection))
            # The pool ends a worker that takes too long; without a pool, the worker ends itself.
            signal.setitimer(signal.ITIMER_REAL, 2 * deadline_s)
            answer = _answer(message)
            signal.setitimer(signal.ITIMER_REAL, 0)
            frames.send(connection, answer)
            del message, answer
    except frames.FrameError:
        return


def _answer(message: dict[str, Any]) -> bytes:
    try:
        return frames.pack({"result": JOBS[message["job"]](**message["arguments"])})
    except MemoryError:
        raise  # the process cannot be used any more
    except Exception:
        return frames.pack({"error": traceback.format_exc()})


if __name__ == "__main__":
    main()
