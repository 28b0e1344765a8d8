"""Processes that are handed over: the kernel says who sent, and all else is checked."""

from __future__ import annotations

import os
import socket
from typing import TYPE_CHECKING

import pytest

from executor.supervision.handover import MOST_FDS, handover_pair, receive, send

if TYPE_CHECKING:
    from collections.abc import Iterator

MARK = "0123456789abcdef"


@pytest.fixture
def pair() -> Iterator[tuple[socket.socket, socket.socket]]:
    ours, theirs = handover_pair()
    with ours, theirs:
        yield ours, theirs


def open_fds() -> int:
    return len(os.listdir("/proc/self/fd"))  # noqa: PTH208 - a count


def test_descriptors_arrive_with_the_sender(pair: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = pair
    read, write = os.pipe()
    send(theirs, 7, MARK, [write])
    os.close(write)
    arrival = receive(ours)
    assert arrival is not None
    assert (arrival.number, arrival.mark, arrival.pid) == (7, MARK, os.getpid())
    (fd,) = arrival.fds
    assert not os.get_inheritable(fd)
    os.write(fd, b"x")
    assert os.read(read, 1) == b"x"
    arrival.close()
    arrival.close()
    assert os.read(read, 1) == b""
    os.close(read)


@pytest.mark.parametrize(
    "data", [b"no", b"1 short", b"-1 " + MARK.encode(), b"1 " + MARK.encode() + b" more"]
)
def test_other_packets_are_refused_and_leave_nothing_open(
    pair: tuple[socket.socket, socket.socket], data: bytes
) -> None:
    ours, theirs = pair
    before = open_fds()
    socket.send_fds(theirs, [data], [0, 1, 2])
    assert receive(ours) is None
    assert open_fds() == before


def test_more_descriptors_than_expected_are_not_taken(pair: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = pair
    before = open_fds()
    socket.send_fds(theirs, [f"1 {MARK}".encode()], [0] * (MOST_FDS * 8))
    arrival = receive(ours)
    assert arrival is None or len(arrival.fds) < MOST_FDS * 8
    if arrival is not None:
        arrival.close()
    assert open_fds() == before


def test_an_end_without_packets_and_a_closed_one(pair: tuple[socket.socket, socket.socket]) -> None:
    ours, theirs = pair
    with pytest.raises(BlockingIOError):
        receive(ours)
    theirs.close()
    with pytest.raises(EOFError):
        receive(ours)
