"""HTTP over a unix socket, for Docker and the keeper."""

from __future__ import annotations

import http.client
import json
import socket
from contextlib import suppress
from typing import Any


class UnixHTTPConnection(http.client.HTTPConnection):
    """A connection to the server that listens at a path."""

    def __init__(self, path: str, timeout_s: float) -> None:
        super().__init__("localhost", timeout=timeout_s)
        self._path = path
        self._timeout_s = timeout_s

    def connect(self) -> None:
        """Connects; called by the base class."""
        self.sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.sock.settimeout(self._timeout_s)
        self.sock.connect(self._path)


def ask(
    path: str, method: str, target: str, body: object = None, *, timeout_s: float = 60
) -> tuple[int, bytes]:
    """Makes one request; returns the status and the body of the answer.

    Raises:
        OSError: no server listens at the path, or the answer took too long.
        http.client.HTTPException: the answer is not HTTP.
    """
    connection = UnixHTTPConnection(path, timeout_s)
    try:
        data = None if body is None else json.dumps(body).encode()
        headers = {} if body is None else {"Content-Type": "application/json"}
        with suppress(BrokenPipeError):  # a refusal may come before the request is read
            connection.request(method, target, data, headers)
        response = connection.getresponse()
        return response.status, response.read()
    finally:
        connection.close()


def read_json(data: bytes) -> Any:
    """Returns the JSON of an answer; None if it is empty or not JSON."""
    try:
        return json.loads(data) if data else None
    except ValueError:
        return None
