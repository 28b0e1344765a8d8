"""The client reads real programs of BehaviorTree.CPP and ours, and outlives hostile ones."""

from __future__ import annotations

import contextlib
import re
import struct
import time
from typing import TYPE_CHECKING

import msgpack
import pytest

from tests.deadline import DEADLINE_S, wait_until
from tests.fakes.groot2_publisher import leaving_publisher, wrong_publisher
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import XML, cpp_program
from tree_gardener import Status, Tree
from tree_gardener.groot import Groot2Publisher, GrootError
from tree_gardener.groot.client import LARGEST_REPLY, Groot2Client, SilenceError, read_address
from tree_gardener.groot.protocol import Hook, HookKey, Mode, Position, Unlock

if TYPE_CHECKING:
    from collections.abc import Callable

    from tree_gardener.groot.remote import Transition

NODES = [
    (1, "Sequence", "top", 0),
    (2, "Script", "Script", 1),
    (3, "SubTree", "mine", 1),
    (4, "Inverter", "mine/Inverter", 2),
    (5, "AlwaysFailure", "mine/hey", 3),
    (6, "SubTree", "Sub::6", 1),
    (7, "Inverter", "Sub::6/Inverter", 2),
    (8, "AlwaysFailure", "Sub::6/hey", 3),
    (9, "Sleep", "Sleep", 1),
    (10, "Script", "Script", 1),
]


def check(client: Groot2Client, until: Callable[[], object]) -> None:
    """Reads everything of a program that runs `XML`."""
    tree = client.tree()
    assert [(node.uid, node.type, node.path, node.depth) for node in tree.nodes] == NODES
    assert tree.scopes == ("Main", "mine", "Sub::6")
    assert tree.nodes[2].attributes["x"] == "{a}"
    end_s = time.monotonic() + DEADLINE_S
    while True:
        until()
        states, dropped = client.statuses()
        boards = client.blackboards(tree.scopes)
        if states[9].status is Status.RUNNING and boards["Main"].get("a") == 3:
            break
        assert time.monotonic() < end_s, (states, boards)
    assert dropped == 0
    assert (states[2].status, states[4].status, states[4].was) == (
        Status.SUCCESS,
        Status.IDLE,
        Status.SUCCESS,
    )
    assert boards == {"Main": {"a": 3, "b": "x"}, "mine": {}, "Sub::6": {}}
    assert client.publisher == tree.id


def test_a_program_of_behaviortree_cpp_is_read() -> None:
    port = free_port()
    with cpp_program(port), Groot2Client("127.0.0.1", port, DEADLINE_S) as client:
        check(client, lambda: None)


def test_a_tree_of_ours_is_read_alike() -> None:
    port = free_port()
    tree = Tree.from_xml(XML)
    with Groot2Publisher(tree, port), Groot2Client("localhost", port, DEADLINE_S) as client:
        check(client, tree.tick_exactly_once)


def test_a_publisher_that_is_replaced_has_another_id() -> None:
    port = free_port()
    with Groot2Client("127.0.0.1", port, DEADLINE_S) as client:
        ids = []
        for _ in range(2):
            with Groot2Publisher(Tree.from_xml(XML), port):
                client.statuses()
                ids.append(client.publisher)
        assert ids[0] != ids[1]


def test_a_program_that_comes_later_is_found_after_silence() -> None:
    port = free_port()
    with Groot2Client("127.0.0.1", port, 0.05) as client:
        with pytest.raises(SilenceError, match="no answer of tcp:"):
            client.tree()
        with Groot2Publisher(Tree.from_xml(XML), port):
            end_s = time.monotonic() + DEADLINE_S
            found = None
            while found is None:
                assert time.monotonic() < end_s
                found = tree_if_answered(client)
            assert len(found) == len(NODES)


def tree_if_answered(client: Groot2Client) -> tuple[object, ...] | None:
    try:
        return client.tree().nodes
    except SilenceError:
        return None


def replying(content: bytes) -> Callable[[list[bytes]], list[bytes]]:
    return lambda parts: [parts[0] + bytes(16), content]


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        (lambda parts: [b"error", b"not today"], "refuses: not"),
        (lambda parts: [b"error"], "refuses"),
        (lambda parts: [b""], "Groot 1"),
        (lambda parts: [parts[0], b"<root/>"], "Groot 1"),
        (lambda parts: [struct.pack("<BBI", 1, ord("T"), 1) + bytes(16), b"<root/>"], "Groot 1"),
        (lambda parts: [parts[0] + bytes(16)], "Groot 1"),
        (replying(b"<root>"), "not XML"),
        (replying(b"<!DOCTYPE a [<!ENTITY b 'c'>]><root/>"), "DTD"),
        (replying(b"<root/>"), "no tree"),
        (replying(b"<root>" + b"<a>" * 5000), "deeply nested"),
        (replying(b"<root><BehaviorTree ID='M' _fullpath=''><A/></BehaviorTree></root>"), "no uid"),
        (replying(b"<root><BehaviorTree ID='M'><A _uid='99999'/></BehaviorTree></root>"), "no uid"),
        (replying(b"<root><BehaviorTree><SubTree _uid='1' _fullpath=''/></BehaviorTree></root>"), "not once"),
        (
            replying(b"<root><BehaviorTree><SubTree _uid='1' _fullpath='x'/></BehaviorTree></root>"),
            "not once",
        ),
    ],
)
def test_a_wrong_answer_is_an_error_with_a_reason(
    answer: Callable[[list[bytes]], list[bytes]], text: str
) -> None:
    port = free_port()
    with (
        wrong_publisher(port, answer),
        Groot2Client("127.0.0.1", port, DEADLINE_S) as client,
        pytest.raises(GrootError, match=text),
    ):
        client.tree()


def test_wrong_statuses_are_dropped_and_counted() -> None:
    port = free_port()
    sent = b"".join(struct.pack("<HB", uid, status) for uid, status in ((1, 2), (2, 99), (3, 12), (4, 5)))
    with wrong_publisher(port, replying(sent + b"x")), Groot2Client("127.0.0.1", port, DEADLINE_S) as client:
        states, dropped = client.statuses()
    assert (sorted(states), dropped) == ([1, 3], 3)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\xc1",
        b"\xdf\xff\xff\xff\xff",
        b"\x91" * 100_000,
        b"\xdd\x7f\xff\xff\xff",
        msgpack.packb(1) + b"x",
    ],
)
def test_a_wrong_blackboard_is_an_error(content: bytes) -> None:
    port = free_port()
    with (
        wrong_publisher(port, replying(content)),
        Groot2Client("127.0.0.1", port, DEADLINE_S) as client,
        pytest.raises(GrootError, match="blackboard"),
    ):
        client.blackboards(("Main",))


def test_a_blackboard_of_another_form_is_left_out() -> None:
    port = free_port()
    content = msgpack.packb({"Main": {"a": [1], 7: 1}, "Other": [1], 5: {}, "None": None})
    with wrong_publisher(port, replying(content)), Groot2Client("127.0.0.1", port, DEADLINE_S) as client:
        assert client.blackboards(("Main",)) == {"Main": {"a": [1]}, "None": {}}


def test_an_endless_answer_is_not_read() -> None:
    port = free_port()
    with (
        wrong_publisher(port, replying(bytes(LARGEST_REPLY + 1))),
        Groot2Client("127.0.0.1", port, 2.0) as client,
        pytest.raises(SilenceError),
    ):
        client.tree()


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("robot.local", ("robot.local", 1667)),
        ("127.0.0.1:7", ("127.0.0.1", 7)),
        ("[::1]:1700", ("[::1]", 1700)),
        ("tcp://robot:5", ("robot", 5)),
    ],
)
def test_an_address_is_host_and_port(text: str, address: tuple[str, int]) -> None:
    assert read_address(text) == address


@pytest.mark.parametrize(
    "text", ["", "*:1667", "ipc:///tmp/x", "host:0", "host:65535", "host:x", "a b", "eth0;x"]
)
def test_other_addresses_are_refused(text: str) -> None:
    with pytest.raises(GrootError, match="HOST:PORT"):
        read_address(text)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("ipc:///tmp/x", "'ipc:' is no program that is reached by TCP"),
        ("inproc://x", "'inproc:' is no program"),
        ("*:1667", "stands for every address"),
        ("0.0.0.0", "stands for every address"),  # noqa: S104 - refused
        ("[::]:1667", "stands for every address"),
        ("eth0;robot:1667", "network interface"),
        ("host:0", "0 is no port"),
    ],
)
def test_the_refusal_of_an_address_says_why(text: str, why: str) -> None:
    with pytest.raises(GrootError, match=re.escape(why)):
        read_address(text)


def hook(
    uid: int, mode: Mode = Mode.BREAKPOINT, status: Status = Status.SKIPPED, *, once: bool = False
) -> Hook:
    return Hook(HookKey(uid, Position.BEFORE), mode, once, status, enabled=True)


def test_a_program_of_behaviortree_cpp_is_held_unlocked_and_forced() -> None:
    port = free_port()
    with cpp_program(port), Groot2Client("127.0.0.1", port, DEADLINE_S) as client:
        client.listen()
        client.tree()
        assert client.hooks() == []
        wait_until(lambda: _is_reached(client, 3), "the breakpoint is reached")
        client.unlock(Unlock(HookKey(3, Position.BEFORE), Status.SKIPPED, remove_when_done=False))
        wait_until(lambda: 3 in client.reached(), "it is reached again")
        client.remove(HookKey(3, Position.BEFORE))
        assert client.hooks() == []
        client.insert([hook(3, Mode.REPLACE, Status.FAILURE)])
        wait_until(lambda: client.statuses()[0][3].was is Status.FAILURE, "it fails")
        with pytest.raises(GrootError, match="refuses"):
            client.remove(HookKey(999, Position.BEFORE))


def _is_reached(client: Groot2Client, uid: int) -> bool:
    """Sets the hook again, since one is not heard that is reached before this client is joined."""
    if uid in client.reached():
        return True
    for each in client.hooks():
        client.remove(each.key)
    client.insert([hook(uid)])
    return False


def test_transitions_of_a_program_are_read() -> None:
    port = free_port()
    with cpp_program(port), Groot2Client("127.0.0.1", port, DEADLINE_S) as client:
        client.tree()
        client.record(on=True)
        found: list[Transition] = []

        def is_all() -> bool:
            transitions, dropped = client.transitions()
            assert dropped == 0
            found.extend(transitions)
            return {uid for _, _, uid, _ in found} >= set(range(1, 11))

        wait_until(is_all, "all nodes change")
        times = [low | high << 32 for low, high, _, _ in found]
        assert times == sorted(times)
        client.record(on=False)


def test_a_connection_that_was_cut_is_reported_once() -> None:
    port = free_port()
    with Groot2Client("127.0.0.1", port, DEADLINE_S) as client:
        with Groot2Publisher(Tree.from_xml(XML), port):
            client.statuses()
            assert not client.take_cut()
        with Groot2Publisher(Tree.from_xml(XML), port):
            client.statuses()
            assert client.take_cut()
            assert not client.take_cut()


def test_a_request_that_was_lost_with_its_connection_is_asked_again() -> None:
    port = free_port()
    with contextlib.ExitStack() as ends, Groot2Client("127.0.0.1", port, DEADLINE_S) as client:

        def replace() -> None:
            ends.enter_context(Groot2Publisher(Tree.from_xml(XML), port))

        with leaving_publisher(port, replace):
            assert set(client.statuses()[0]) == {uid for uid, *_ in NODES}
            assert client.take_cut()
            assert not client.take_cut()


def test_a_change_that_was_lost_with_its_connection_is_not_made_in_another_program() -> None:
    port = free_port()
    with contextlib.ExitStack() as ends, Groot2Client("127.0.0.1", port, 2.0) as client:

        def replace() -> None:
            ends.enter_context(Groot2Publisher(Tree.from_xml(XML), port))

        with leaving_publisher(port, replace), pytest.raises(SilenceError):
            client.insert([hook(3)])
        assert client.hooks() == []
