"""Pulling a recording from a manager that may be hostile."""

from __future__ import annotations

import io
import socket
from typing import Any

import pytest

from backend.runs.errors import NoAnswerError, NotRecordedError, RunQuotaError
from backend.runs.pull import pull
from tests.fakes.recordings import TOKEN, recordings

DATA = bytes(range(256)) * 2000
MOST = 10**9


def test_all_parts_become_one_file():
    out = io.BytesIO()
    with recordings(DATA) as address:
        assert pull(address, TOKEN, "a1", out, MOST) == len(DATA)
    assert out.getvalue() == DATA


def test_a_recording_that_grew_meanwhile_is_read_again():
    out = io.BytesIO()
    with recordings(DATA, fault="grows") as address:
        assert pull(address, TOKEN, "a1", out, MOST) == len(DATA)
    assert out.getvalue() == DATA


@pytest.mark.parametrize(
    ("fault", "error", "text"),
    [
        ("changes", NoAnswerError, "changed each time that it was read"),
        ("cut", NoAnswerError, "did not give|ended too early"),
        ("skips", NoAnswerError, "another part"),
        ("hangs_up", NoAnswerError, "did not give"),
        ("conflict", NoAnswerError, "could not put"),
        ("huge", RunQuotaError, "1,000,000,000,000 bytes, and you have room for 1,000,000,000"),
    ],
)
def test_a_manager_that_lies_is_refused(fault, error, text):
    with recordings(DATA, fault=fault) as address, pytest.raises(error, match=text):
        pull(address, TOKEN, "a1", io.BytesIO(), MOST)


def test_what_is_not_there_is_said():
    with recordings(DATA) as address:
        with pytest.raises(NotRecordedError, match="no recording of the run b2"):
            pull(address, TOKEN, "b2", io.BytesIO(), MOST)
        with pytest.raises(NotRecordedError):
            pull(address, "wrong", "a1", io.BytesIO(), MOST)
    with pytest.raises(NoAnswerError):
        pull(address, TOKEN, "a1", io.BytesIO(), MOST)


def test_nothing_is_written_beyond_the_quota():
    out = io.BytesIO()
    with recordings(DATA) as address, pytest.raises(RunQuotaError, match="room for 0"):
        pull(address, TOKEN, "a1", out, -5)
    assert out.getvalue() == b""


def test_a_unix_socket_is_an_address_too(tmp_path, monkeypatch):
    """The path is connected to; the rest is the same."""
    seen: list[Any] = []

    def connect(self: socket.socket, to: object) -> None:
        seen.append((self.family, to))
        raise ConnectionRefusedError

    monkeypatch.setattr(socket.socket, "connect", connect)
    with pytest.raises(NoAnswerError):
        pull(f"unix:{tmp_path}/manager", TOKEN, "a1", io.BytesIO(), MOST)
    assert seen == [(socket.AF_UNIX, f"{tmp_path}/manager")]
