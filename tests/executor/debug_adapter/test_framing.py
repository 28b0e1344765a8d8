"""The framing of the Debug Adapter Protocol."""

from __future__ import annotations

import io

import pytest

from executor.debug_adapter.framing import MOST_BYTES, FramingError, framed, read_framed


def test_messages_come_back_one_by_one():
    source = io.BytesIO(framed(b"{}") + framed("ä".encode()) + framed(b""))
    assert [read_framed(source) for _ in range(4)] == [b"{}", "ä".encode(), b"", None]


def test_other_headers_are_passed_over():
    assert read_framed(io.BytesIO(b"Content-Type: x\r\ncontent-length:2\r\n\r\n{}")) == b"{}"


@pytest.mark.parametrize(
    "data",
    [
        b"\r\n{}",
        b"Content-Length: x\r\n\r\n{}",
        b"Content-Length: -2\r\n\r\n{}",
        b"Content-Length: %d\r\n\r\n{}" % (MOST_BYTES + 1),
        b"Content-Length: 3\r\n\r\n{}",
    ],
)
def test_wrong_frames_are_refused(data: bytes):
    with pytest.raises(FramingError):
        read_framed(io.BytesIO(data))
