"""The messages of the Debug Adapter Protocol on the standard streams of this process."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import queue
import sys
import threading
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from executor.debug_adapter.framing import FramingError, framed, read_framed

if TYPE_CHECKING:
    from typing import BinaryIO

__all__ = ["GONE", "Request", "Wire", "own_streams"]

LONGEST_LINE: Final = 1 << 16
GONE: Final = "disconnect"
"""The command that stands for the end of the input."""


@dataclass(frozen=True)
class Request:
    """A request of the client."""

    seq: int
    command: str
    arguments: dict[str, Any] = field(default_factory=dict)

    def text(self, name: str, default: str = "") -> str:
        """Returns an argument that is a text."""
        found = self.arguments.get(name)
        return found if isinstance(found, str) else default

    def number(self, name: str, default: int = 0) -> int:
        """Returns an argument that is a whole number."""
        found = self.arguments.get(name)
        return found if type(found) is int else default


class Wire:
    """Reads requests on a thread of its own, and writes responses and events from any thread.

    Args:
        source, sink: the streams of the client.

    Attributes:
        requests: the requests that came; one of `GONE` at the end of the input.
    """

    def __init__(self, source: BinaryIO, sink: BinaryIO) -> None:
        self.requests: queue.Queue[Request] = queue.Queue()
        self._source, self._sink = source, sink
        self._seq = itertools.count(1)
        self._lock = threading.Lock()
        threading.Thread(target=self._read, name="dap", daemon=True).start()

    def respond(self, request: Request, body: dict[str, Any] | None = None) -> None:
        """Answers a request."""
        self._send(_answer(request) | {"success": True, "body": body or {}})

    def refuse(self, request: Request, why: str) -> None:
        """Answers a request with the reason why it is not done."""
        error = {"id": 1, "format": "{why}", "variables": {"why": why}, "showUser": True}
        self._send(_answer(request) | {"success": False, "message": why, "body": {"error": error}})

    def tell(self, event: str, **body: Any) -> None:
        """Sends an event."""
        self._send({"type": "event", "event": event, "body": body})

    def say(self, text: str, category: str = "console") -> None:
        """Sends a line of output."""
        self.tell("output", category=category, output=f"{text}\n")

    def _send(self, message: dict[str, Any]) -> None:
        with (
            self._lock,
            contextlib.suppress(OSError, ValueError),
        ):  # the end of the input says that it is gone
            text = json.dumps({"seq": next(self._seq), **message}).encode()
            self._sink.write(framed(text))
            self._sink.flush()

    def _read(self) -> None:
        with contextlib.suppress(FramingError, OSError, ValueError):
            while (text := read_framed(self._source)) is not None:
                if (request := _request(text)) is not None:
                    self.requests.put(request)
        self.requests.put(Request(0, GONE))


def _answer(request: Request) -> dict[str, Any]:
    return {"type": "response", "request_seq": request.seq, "command": request.command}


def _request(text: bytes) -> Request | None:
    """Returns a request; None for anything else."""
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        return None
    if not isinstance(message, dict) or message.get("type") != "request":
        return None
    seq, command, arguments = message.get("seq"), message.get("command"), message.get("arguments")
    if type(seq) is not int or not isinstance(command, str):
        return None
    return Request(seq, command, arguments if isinstance(arguments, dict) else {})


@contextlib.contextmanager
def own_streams() -> Any:
    """Yields a wire on the standard streams; the prints of this process become its output meanwhile."""
    source, sink, errors = os.dup(0), os.dup(1), os.dup(2)
    wire = Wire(os.fdopen(source, "rb"), os.fdopen(sink, "wb"))
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    readers = [_redirect(wire, number, name) for number, name in ((1, "stdout"), (2, "stderr"))]
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    try:
        yield wire
    finally:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        os.dup2(errors, 1)
        os.dup2(errors, 2)
        for reader in readers:
            reader.join(1.0)


def _redirect(wire: Wire, number: int, category: str) -> threading.Thread:
    read, write = os.pipe()
    os.dup2(write, number)
    os.close(write)

    def forward() -> None:
        with os.fdopen(read, "r", encoding="utf-8", errors="replace", newline="\n") as lines:
            while line := lines.readline(LONGEST_LINE):
                wire.say(line.rstrip("\n"), category)

    thread = threading.Thread(target=forward, name=category, daemon=True)
    thread.start()
    return thread
