"""Messages between the pool and a worker."""

from __future__ import annotations

import socket

import pytest

from backend.workers import frames
from backend.workers.frames import PREFIX, FrameError, pack, receive, send


def test_a_message_arrives_as_it_was_packed() -> None:
    one, other = socket.socketpair()
    with one, other:
        send(one, pack({"b": 1, "a": b"x"}))
        assert bytes(receive(other)) == pack({"a": b"x", "b": 1})


def test_an_end_and_a_message_that_is_too_large_are_errors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frames, "MAX_BYTES", 10)
    one, other = socket.socketpair()
    with one, other:
        one.sendall(PREFIX.pack(11))
        with pytest.raises(FrameError, match="too large"):
            receive(other)
        one.sendall(PREFIX.pack(5) + b"x")
        one.shutdown(socket.SHUT_WR)
        with pytest.raises(FrameError, match="gone"):
            receive(other)


def test_a_time_that_is_over_is_distinguished_from_an_end() -> None:
    one, other = socket.socketpair()
    with one, other:
        other.settimeout(0.01)
        with pytest.raises(TimeoutError):
            receive(other)
