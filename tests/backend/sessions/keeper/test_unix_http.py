"""HTTP over a unix socket."""

from __future__ import annotations

import socket
from concurrent.futures import ThreadPoolExecutor

from backend.sessions.keeper.unix_http import ask

REFUSAL = b"HTTP/1.1 413 Too Large\r\nContent-Length: 4\r\nConnection: close\r\n\r\nlong"


def refuse_unread(listener):
    """Answers one request by its headers alone."""
    connection, _ = listener.accept()
    with connection:
        heard = b""
        while b"\r\n\r\n" not in heard:
            heard += connection.recv(1)
        connection.sendall(REFUSAL)


def test_an_answer_that_comes_before_all_was_sent_is_heard(tmp_path):
    path = str(tmp_path / "socket")
    with socket.socket(socket.AF_UNIX) as listener, ThreadPoolExecutor(1) as server:
        listener.bind(path)
        listener.listen()
        served = server.submit(refuse_unread, listener)
        assert ask(path, "POST", "/sessions", "more than a socket holds" * 100_000) == (413, b"long")
        served.result()
