"""Clients see of our trees what they see of BehaviorTree.CPP's, and force the same results."""

from __future__ import annotations

import functools
import json
import random
import socket
import struct
import threading
import time
from typing import TYPE_CHECKING, Any

import pytest
import zmq

from tests.budget import count, seeds
from tests.deadline import DEADLINE_S
from tests.tree_gardener.debugging import hooked
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.fuzz.compare import reference_traces
from tests.tree_gardener.fuzz.generate import generate
from tests.tree_gardener.fuzz.trace import run_ours
from tests.tree_gardener.groot import published
from tests.tree_gardener.groot.zmtp import Groot2
from tree_gardener import LoadError, Tree
from tree_gardener.groot import Groot2Publisher, GrootError, publisher
from tree_gardener.groot.mirror import Mirror

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from tests.tree_gardener.fuzz.generate import Case
    from tests.tree_gardener.fuzz.reference import Line

XML = """<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>
<Script code="first := 1"/><Script code="second := 1"/><Sleep msec="60000"/>
</Sequence></BehaviorTree></root>"""
FIRST, SECOND = 2, 3


class Followed:
    """A tree that ticks in a thread, its publisher and a client."""

    def __init__(self) -> None:
        self.tree = Tree.from_xml(XML)
        self.port = free_port()
        self.publisher = Groot2Publisher(self.tree, self.port)
        self.client = Groot2(self.port)
        self.context = zmq.Context()
        self.news: zmq.Socket[bytes] = self.context.socket(zmq.SUB)
        self.news.setsockopt(zmq.RCVTIMEO, round(DEADLINE_S * 1000))
        self.news.subscribe(b"")
        self.news.connect(f"tcp://127.0.0.1:{self.port + 1}")
        self.is_over = threading.Event()
        self.thread = threading.Thread(target=self.tick)

    def tick(self) -> None:
        while not self.is_over.wait(0.005):
            self.tree.tick_exactly_once()

    def hook(self, uid: int, mode: int = 0, **more: Any) -> None:
        given = {"enabled": True, "once": False, "desired_status": "SKIPPED", "position": 0}
        self.client.insert_hooks([{**given, "uid": uid, "mode": mode, **more}])

    def reached(self) -> int:
        """Waits for the news of a hook that was reached; returns the uid of its node."""
        header, uid = self.news.recv_multipart()
        assert struct.unpack("<BBI", header)[:2] == (2, ord("N"))
        return int(uid)

    def until(self, wanted: Any) -> None:
        """Waits until a function of the statuses by uid is true."""
        end_s = time.monotonic() + DEADLINE_S
        while not wanted(self.statuses()):
            assert time.monotonic() < end_s, self.statuses()
            time.sleep(0.005)

    def statuses(self) -> dict[int, int]:
        return dict(struct.iter_unpack("<HB", self.client.ask("S")[0]))

    def board(self) -> bytes:
        return self.client.ask("B", b"Main")[0]

    def close(self) -> None:
        self.publisher.close()
        self.is_over.set()
        if self.thread.ident is not None:
            self.thread.join(DEADLINE_S)
        assert not self.thread.is_alive()
        self.client.close()
        self.context.destroy(linger=0)


@pytest.fixture
def followed() -> Iterator[Followed]:
    found = Followed()
    yield found
    found.close()


@functools.cache
def references() -> list[tuple[Case, list[Line] | None]]:
    """Random trees, and what a client sees of them in BehaviorTree.CPP."""
    cases = [generate(seed) for seed in range(1, count("groot_publisher_trees") + 1)]
    return list(zip(cases, reference_traces(cases, published.__name__), strict=True))


@pytest.mark.timeout(1800)
def test_a_client_sees_what_it_sees_of_behaviortree_cpp() -> None:
    compared = seen = 0
    for case, reference in references():
        if reference is not None:
            found = published.agreed(reference, published.ours(case))
            assert found == reference, f"seed {case.seed}\n{case.xml()}"
            compared += 1
            seen += sum("seen" in line for line in found)
    assert compared >= 0.9 * len(references())
    assert seen >= 2 * compared


def test_a_wrong_picture_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    some = references()[:4]
    monkeypatch.setattr(Mirror, "ticked", lambda mirror, changes: None)
    assert any(
        published.agreed(reference, published.ours(case)) != reference
        for case, reference in some
        if reference
    )


@pytest.mark.timeout(900)
def test_results_are_forced_as_by_behaviortree_cpp() -> None:
    wanted = [hooked.forced(seed) for seed in range(1, count("groot_publisher_trees") + 1)]
    compared = 0
    for each, reference in zip(wanted, reference_traces(wanted, hooked.__name__), strict=True):
        if reference is not None:
            assert forced_by_hooks(each) == reference, f"seed {each.case.seed}: {each.forces}"
            compared += 1
    assert compared >= 0.9 * len(wanted)


def forced_by_hooks(wanted: hooked.Forced) -> list[Any]:
    """Our trace, with the results forced by a client of our publisher."""
    ends: list[Any] = []

    def prepare(tree: Tree) -> None:
        port = free_port()
        ends.append(Groot2Publisher(tree, port).close)
        client = Groot2(port)
        ends.append(client.close)
        # The oracle takes both positions for that before the tick.
        client.insert_hooks([hooked.hook_of(force, 0) for force, _ in wanted.forces])
        tree.fire_timers()

    try:
        return run_ours(wanted.case, prepare)
    except LoadError:
        return [{"load": "refused"}]
    finally:
        for end in reversed(ends):
            end()


def test_a_tree_waits_at_a_breakpoint_until_it_is_unlocked(followed: Followed) -> None:
    followed.hook(SECOND)
    followed.thread.start()
    assert followed.reached() == SECOND
    assert followed.statuses() == {1: 1, FIRST: 2, SECOND: 0, 4: 0}
    assert followed.board() == b"\x81\xa4Main\x81\xa5first\x01"
    followed.client.ask(
        "U", b'{"uid": 3, "position": 0, "desired_status": "SKIPPED", "remove_when_done": true}'
    )
    followed.until(lambda statuses: statuses == {1: 1, FIRST: 2, SECOND: 2, 4: 1})
    assert followed.client.hooks() == []


def test_a_breakpoint_is_left_with_a_result(followed: Followed) -> None:
    followed.hook(FIRST, position=1)
    followed.thread.start()
    assert followed.reached() == FIRST
    unlock = b'{"uid": 2, "position": 1, "desired_status": "FAILURE", "remove_when_done": true}'
    followed.client.ask("U", unlock)
    followed.until(lambda statuses: statuses[4] == 1)  # the tree began again after the failure
    assert b"first" in followed.board()


@pytest.mark.parametrize("request_", ["A", "X"])
def test_a_tree_that_waits_continues_when_its_breakpoint_is_gone(followed: Followed, request_: str) -> None:
    followed.hook(FIRST)
    followed.thread.start()
    followed.reached()
    followed.client.ask(request_)
    followed.until(lambda statuses: statuses[4] == 1)


def test_a_client_that_is_gone_frees_the_tree(followed: Followed, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(publisher, "SILENCE_S", 0.2)
    followed.hook(FIRST)
    followed.thread.start()
    followed.reached()
    end_s = time.monotonic() + DEADLINE_S
    while followed.tree.tick_number < 5:  # it asks nothing meanwhile
        assert time.monotonic() < end_s
        time.sleep(0.01)
    assert followed.client.hooks()[0]["enabled"]  # the next request switches them on again


def test_a_hook_that_comes_while_the_tree_waits_acts_in_the_same_tick(followed: Followed) -> None:
    followed.hook(FIRST)
    followed.thread.start()
    assert followed.reached() == FIRST
    followed.hook(SECOND, mode=1, desired_status="FAILURE")
    followed.client.ask(
        "U", b'{"uid": 2, "position": 0, "desired_status": "SKIPPED", "remove_when_done": true}'
    )
    assert followed.reached() == SECOND
    assert b"second" not in followed.board()


def test_transitions_are_kept_while_they_are_recorded(followed: Followed) -> None:
    followed.client.ask("S")
    followed.tree.fire_timers()
    begin_us = int(followed.client.ask("r", b"start")[0])
    assert abs(begin_us - time.time_ns() // 1000) < 60_000_000
    followed.tree.tick_exactly_once()
    taken = followed.client.ask("t")[0]
    steps = [(taken[at + 6] + 256 * taken[at + 7], taken[at + 8]) for at in range(0, len(taken), 9)]
    assert sorted(steps) == [(1, 1), (FIRST, 2), (SECOND, 2), (4, 1)]
    assert followed.client.ask("t") == [b""]
    followed.client.ask("r", b"stop")
    followed.tree.halt()
    assert followed.client.ask("t") == [b""]


def test_nothing_is_attached_without_a_client_or_after_it(
    followed: Followed, monkeypatch: pytest.MonkeyPatch
) -> None:
    observed: list[str] = []
    observe = followed.tree.observe

    def count_observers(callback: Any) -> Any:
        observed.append("begins")
        unsubscribe = observe(callback)
        return lambda: (observed.append("ends"), unsubscribe())

    monkeypatch.setattr(followed.tree, "observe", count_observers)
    followed.tree.tick_exactly_once()
    assert observed == []
    monkeypatch.setattr(publisher, "SILENCE_S", 0.2)
    followed.client.ask("S")
    followed.thread.start()
    end_s = time.monotonic() + DEADLINE_S
    while observed != ["begins", "ends"]:
        assert time.monotonic() < end_s, observed
        time.sleep(0.01)


def test_ports_in_use_are_named() -> None:
    port = free_port()
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", port + 1))
        with pytest.raises(GrootError, match=f"{port} and {port + 1}"):
            Tree.from_xml(XML).publish_groot2(port)
    with pytest.raises(GrootError, match="two ports"):
        Tree.from_xml(XML).publish_groot2(65535)


def test_requests_of_any_bytes_get_an_answer(followed: Followed) -> None:
    for parts in (
        [b""],
        [b"\x02"],
        [struct.pack("<BBI", 1, ord("S"), 1)],
        [struct.pack("<BBI", 2, ord("N"), 1)],
        [struct.pack("<BBI", 2, ord("I"), 1), b"[" * 100_000],
        [struct.pack("<BBI", 2, ord("I"), 1), b"\xff"],
        [struct.pack("<BBI", 2, ord("B"), 1), b"\xff;" * 1000],
        [struct.pack("<BBI", 2, ord("U"), 1), b"{}", b"more"],
    ):
        assert followed.client.request.ask(*parts)
    assert len(followed.statuses()) == 4


STATUSES = ("SUCCESS", "FAILURE", "SKIPPED", "RUNNING", "IDLE", "", 2, None)
CONTENTS: dict[str, Callable[[random.Random], Any]] = {
    "I": lambda chance: [any_hook(chance) for _ in range(chance.choice((1, 1, 3)))],
    "R": lambda chance: {"uid": any_uid(chance), "position": any_number(chance)},
    "U": lambda chance: {
        "uid": any_uid(chance),
        "position": any_number(chance),
        "desired_status": chance.choice(STATUSES),
        "remove_when_done": chance.choice((True, False, 1, None)),
    },
}


def any_uid(chance: random.Random) -> Any:
    return chance.choice((1, FIRST, SECOND, 4, 0, -1, 5, 70_000, 1 << 70, 2.0, "2", None))


def any_number(chance: random.Random) -> Any:
    return chance.choice((0, 1, 0, 1, 2, -1, 0.5, True, "0", None, []))


def any_hook(chance: random.Random) -> Any:
    hook = {
        "enabled": chance.choice((True, False, True, "x")),
        "uid": any_uid(chance),
        "mode": any_number(chance),
        "once": chance.choice((True, False)),
        "desired_status": chance.choice(STATUSES),
        "position": any_number(chance),
    }
    if chance.random() < 0.2:
        del hook[chance.choice(list(hook))]
    return chance.choice((hook, hook, hook, [hook], None))


def any_request(chance: random.Random) -> list[bytes]:
    """Returns a request that is sound, or wrong in its type, length or content."""
    kind = chance.choice("TSBIRADXUrtNIRUIRU\0\xff")
    content = json.dumps(CONTENTS[kind](chance)).encode() if kind in CONTENTS else b"Main;x"
    if kind == "r":
        content = chance.choice((b"start", b"stop", b""))
    header = struct.pack("<BBI", chance.choice((2, 2, 2, 2, 2, 1, 0)), ord(kind), chance.randrange(1 << 32))
    if chance.random() < 0.2:
        at = chance.randrange(len(content) + 1)
        content = content[:at] + chance.randbytes(chance.randrange(9)) + content[at + chance.randrange(9) :]
    if chance.random() < 0.05:
        header = header[: chance.randrange(6)] or b"\0"
    parts = [header, content, b"more"]
    return parts[: chance.choice((1, 2, 2, 2, 2, 3) if kind not in "TSADXt" else (1, 1, 1, 2))]


def test_random_requests_are_answered_and_leave_the_tree_as_it_was(followed: Followed) -> None:
    """A tree that ticks meanwhile is held and forced by them; without their hooks it runs as before."""
    followed.thread.start()
    done = refused = 0
    for seed in seeds("groot_hostile_requests"):
        chance = random.Random(seed)  # noqa: S311 - reproducible, no secret
        parts = any_request(chance)
        first, *rest = followed.client.request.ask(*parts)
        if first == b"error":
            refused += 1
            assert len(rest) == 1, (seed, parts)
            assert rest[0], (seed, parts)
        else:
            done += 1
            assert first[:6] == parts[0], (seed, parts)
    assert min(done, refused) > 20
    followed.client.ask("A")
    followed.until(lambda statuses: statuses == {1: 1, FIRST: 2, SECOND: 2, 4: 1})
    assert followed.client.hooks() == []
