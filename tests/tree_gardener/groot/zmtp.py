"""A client of ZeroMQ's REQ socket (ZMTP 3.0, mechanism NULL), and of Groot2's protocol: what tests need."""

from __future__ import annotations

import itertools
import json
import socket
import struct
import time
from typing import Any

_GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\0") + bytes(32)
_READY = b"\x05READY\x0bSocket-Type" + struct.pack(">I", 3) + b"REQ"
_MORE, _LONG, _COMMAND = 1, 2, 4


class Request:
    """A REQ socket that is connected to localhost."""

    def __init__(self, port: int, timeout_s: float = 10.0) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port), timeout_s)
        # As ZeroMQ does: a frame would wait 40 ms for the acknowledgement of the one before.
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.sendall(_GREETING)
        self.receive(64)
        self.send_frame(_COMMAND, _READY)
        self.frame()  # the peer's READY

    def receive(self, length: int) -> bytes:
        """Receives exactly so many bytes."""
        found = b""
        while len(found) < length:
            more = self.socket.recv(length - len(found))
            if not more:
                raise ConnectionError("the peer closed the connection")
            found += more
        return found

    def send_frame(self, flags: int, body: bytes) -> None:
        """Sends one frame."""
        if len(body) > 255:
            self.socket.sendall(struct.pack(">BQ", flags | _LONG, len(body)) + body)
        else:
            self.socket.sendall(struct.pack(">BB", flags, len(body)) + body)

    def frame(self) -> tuple[int, bytes]:
        """Receives one frame."""
        flags = self.receive(1)[0]
        length = struct.unpack(">Q", self.receive(8))[0] if flags & _LONG else self.receive(1)[0]
        return flags, self.receive(length)

    def ask(self, *parts: bytes) -> list[bytes]:
        """Sends a request of several parts, and returns the parts of the reply."""
        self.send_frame(_MORE, b"")
        for index, part in enumerate(parts):
            self.send_frame(_MORE if index + 1 < len(parts) else 0, part)
        found: list[bytes] = []
        while True:
            flags, body = self.frame()
            found.append(body)
            if not flags & _MORE:
                return found[1:]

    def close(self) -> None:
        """Closes the connection."""
        self.socket.close()


class Groot2:
    """A client of a Groot2 publisher."""

    def __init__(self, port: int) -> None:
        self.request = Request(port)
        self.ids = itertools.count(1)

    @classmethod
    def as_soon_as_served(cls, port: int) -> Groot2:
        """Waits for a publisher."""
        end_s = time.monotonic() + 60
        while True:
            try:
                return cls(port)
            except OSError:
                assert time.monotonic() < end_s
                time.sleep(0.01)

    def ask(self, kind: str, *parts: bytes) -> list[bytes]:
        """Sends a request of a type; returns the parts of the reply behind its header.

        Raises:
            RuntimeError: the publisher refused.
        """
        header = struct.pack("<BBI", 2, ord(kind), next(self.ids))
        reply = self.request.ask(header, *parts)
        if reply[0] == b"error" or reply[0][:6] != header:
            raise RuntimeError(f"the reply to {kind} is {reply}")
        return reply[1:]

    def insert_hooks(self, hooks: list[dict[str, Any]]) -> None:
        """Inserts hooks."""
        self.ask("I", json.dumps(hooks).encode())

    def hooks(self) -> list[dict[str, Any]]:
        """Returns the hooks that the publisher has."""
        found: list[dict[str, Any]] = json.loads(self.ask("D")[0])
        return found

    def close(self) -> None:
        """Closes the connection."""
        self.request.close()
