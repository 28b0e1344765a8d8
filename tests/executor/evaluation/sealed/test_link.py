"""The link of a sealed run: messages arrive as they were, and hostile bytes are refused."""

import os
import socket
import struct
import subprocess
import threading

import pytest

from executor.evaluation.sealed.link import (
    MOST_CLAIMED,
    Heard,
    Link,
    LinkClosedError,
    LinkError,
    Sent,
    Tick,
    Ticked,
)


@pytest.fixture
def pair():
    ours, theirs = socket.socketpair()
    with ours, theirs:
        yield Link(ours), Link(theirs), theirs


def test_messages_arrive_as_they_were(pair):
    judge, actions, _ = pair
    tick = Tick(0.05, [Sent(3, b"x" * 500_000)])
    sender = threading.Thread(target=judge.send, args=(tick,))
    sender.start()
    assert actions.receive_of_judge() == tick
    sender.join()
    ticked = Ticked([1, 0], [Heard("/cmd_vel", "geometry_msgs/msg/Twist", b"y")], "RUNNING")
    actions.send(ticked)
    assert judge.receive_of_actions() == ticked


def test_a_closed_end_is_an_error(pair):
    judge, actions, _ = pair
    actions.close()
    with pytest.raises(LinkClosedError):
        judge.receive_of_actions()
    with pytest.raises(LinkClosedError):
        judge.send(Tick(0.0, []))


def test_the_end_of_a_process_closes_its_link_though_a_fork_of_it_holds_the_end(pair):
    ended = subprocess.Popen(["true"])
    process_fd = os.pidfd_open(ended.pid)
    ours, fork = socket.socketpair()
    with ours, fork:
        judge = Link(ours, process_fd)
        Link(fork).send(Ticked([1], []))
        assert judge.receive_of_actions() == Ticked([1], [])
        with pytest.raises(LinkClosedError):
            judge.receive_of_actions()
    os.close(process_fd)
    ended.wait()


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"\xc1",
        b"\x81\xa4type\xa8Decision",
        b'{"outcome": "success"}',
        b"\xdd\xff\xff\xff\xff",
        b"\x91" * 100_000,
    ],
)
def test_what_is_no_message_is_refused(body, pair):
    judge, _, raw = pair
    raw.sendall(struct.pack("<I", len(body)) + body)
    with pytest.raises(LinkError, match="no message"):
        judge.receive_of_actions()


def test_a_length_beyond_the_limit_is_refused_before_memory_is_taken(pair):
    judge, _, raw = pair
    raw.sendall(struct.pack("<I", MOST_CLAIMED + 1))
    with pytest.raises(LinkError, match="too long"):
        judge.receive_of_actions()
