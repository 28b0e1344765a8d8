"""Messages over a link are not trusted."""

from __future__ import annotations

import os
import socket
import struct

import msgspec
import pytest

from executor.recorder.link import MOST_BATCH_BYTES, Mark
from executor.recorder.sources import BrokenSource, Source, listen, take_source


def pair() -> tuple[socket.socket, Source]:
    ours, theirs = socket.socketpair()
    theirs.setblocking(False)
    return ours, Source(theirs)


@pytest.mark.parametrize(
    "data",
    [
        struct.pack("<I", MOST_BATCH_BYTES + 1),
        struct.pack("<I", 3) + b"abc",
        struct.pack("<I", 2) + msgspec.msgpack.encode([None]),
        struct.pack("<I", 5) + b"\x91" * 5,
    ],
)
def test_bytes_that_are_no_message_end_the_connection(data):
    ours, source = pair()
    with ours:
        ours.sendall(data)
        with pytest.raises(BrokenSource):
            list(source.messages())
    source.connection.close()


def test_a_message_may_come_in_pieces():
    ours, source = pair()
    body = msgspec.msgpack.encode([Mark("r1")])
    data = struct.pack("<I", len(body)) + body
    with ours:
        ours.sendall(data[:6])
        assert list(source.messages()) == []
        ours.sendall(data[6:])
        assert list(source.messages()) == [Mark("r1")]
        assert source.run == "r1"
    source.connection.close()


def test_two_recorders_cannot_listen_at_one_address_and_only_this_user_is_taken():
    address = f"bt-studio-test-{os.getpid()}"
    with listen(address) as listener:
        with pytest.raises(OSError, match="in use"):
            listen(address)
        with socket.socket(socket.AF_UNIX) as client:
            client.connect(f"\0{address}")
            source = take_source(listener)
            assert source is not None
            assert source.process == os.getpid()
            source.connection.close()


def test_another_user_is_refused(monkeypatch):
    address = f"bt-studio-test-{os.getpid()}-other"
    uid = os.getuid()
    with listen(address) as listener, socket.socket(socket.AF_UNIX) as client:
        client.connect(f"\0{address}")
        monkeypatch.setattr(os, "getuid", lambda: uid + 1)
        assert take_source(listener) is None
        assert client.recv(1) == b""  # the connection is closed
