"""The process follows real programs of BehaviorTree.CPP, and outlives those that die, change or lie."""

from __future__ import annotations

import random
import struct
import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pytest

from executor import child_messages, messages
from executor.attached.process import Follower
from executor.child_messages import decode_from_application, decode_to_application
from executor.supervision.channel import Channel, ChannelClosed, socket_pair
from tests.budget import seeds
from tests.deadline import DEADLINE_S
from tests.fakes.groot2_publisher import wrong_publisher
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import XML, cpp_program
from tree_gardener import Tree
from tree_gardener.groot import Groot2Publisher
from tree_gardener.groot.document import document_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path


class Pulse:
    """The signs of life, which nobody reads."""

    def moved(self) -> None: ...

    def rests(self) -> None: ...

    @contextmanager
    def busy(self, _: str) -> Iterator[None]:
        yield


class Session:
    """The session at the other end of the channel of a follower."""

    def __init__(self, folder: Path, port: int) -> None:
        ours, theirs = socket_pair()
        self.channel: Any = Channel(ours.detach(), decode_from_application)
        self.said: list[Any] = []
        channel: Any = Channel(theirs.detach(), decode_to_application)
        follower = Follower(channel, Pulse(), "")  # type: ignore[arg-type]

        def run() -> None:
            follower.run()
            channel.close()

        self.thread = threading.Thread(target=run)
        self.thread.start()
        self.tell(child_messages.StartApplication(str(folder), 20.0, attach=f"127.0.0.1:{port}"))

    def tell(self, message: Any) -> None:
        self.channel.send(message)

    def hear(self, kind: type, is_it: Callable[[Any], bool] = lambda _: True) -> Any:
        end_s = time.monotonic() + DEADLINE_S
        while time.monotonic() < end_s:
            message = self.channel.receive(0.1)
            if message is not None:
                self.said.append(message)
                if isinstance(message, kind) and is_it(message):
                    return message
        raise AssertionError(f"no {kind.__name__} came; {[type(each).__name__ for each in self.said[-9:]]}")

    def close(self) -> None:
        try:
            self.tell(child_messages.Stop())
            while True:
                self.channel.receive(0.1)
        except ChannelClosed:
            pass
        self.thread.join(DEADLINE_S)
        assert not self.thread.is_alive()


@contextmanager
def following(folder: Path, port: int) -> Iterator[Session]:
    session = Session(folder, port)
    try:
        yield session
    finally:
        session.close()


def state(wanted: str) -> Callable[[Any], bool]:
    return lambda message: message.state == wanted


def test_a_program_is_followed_held_and_lost_while_it_is_held(tmp_path: Path) -> None:
    port = free_port()
    with cpp_program(port) as program, following(tmp_path, port) as session:
        tree = session.hear(child_messages.AttachedTree)
        assert sorted(tree.files) == ["project.json", "trees/Main.json", "trees/Sub.json"]
        assert (tmp_path / "trees" / "Main.json").read_text() == tree.files["trees/Main.json"]
        assert len(session.hear(child_messages.Tree).nodes) == 10
        session.hear(child_messages.ApplicationReady)
        session.hear(child_messages.Attached, state("following"))
        session.hear(child_messages.Tick, lambda tick: (9, "RUNNING") in [tuple(one) for one in tick.changed])
        session.hear(child_messages.Blackboard, lambda board: "a" in {entry.key for entry in board.entries})
        session.tell(child_messages.BeginRecording("run1"))
        session.tell(child_messages.Control(on=True, request="c"))
        session.hear(child_messages.Attached, lambda told: told.controls)
        wanted = messages.SetBreakpoints([messages.Breakpoint("Sub", "u5")])
        session.tell(child_messages.SetBreakpoints(wanted=wanted, request="b"))
        assert session.hear(child_messages.Answer, lambda answer: answer.request == "b").error is None
        assert session.hear(child_messages.Held).path == [1, 3, 4, 5]
        session.tell(child_messages.Continue(request="go"))
        session.hear(child_messages.Released)
        session.hear(child_messages.Held, lambda held: held.uid == 8)
        wrong = messages.SetBreakpoints([messages.Breakpoint("Sub", "u5", condition="a > 1")])
        session.tell(child_messages.SetBreakpoints(wanted=wrong))  # no client waits for the refusal
        assert "condition" in session.hear(child_messages.Log).text
        program.kill()
        session.hear(child_messages.Released)
        assert "no answer" in session.hear(child_messages.Attached, state("silent")).problem
        session.tell(child_messages.ForceResult(force=messages.Force(5, "mine/hey"), request="f"))
        refused = session.hear(child_messages.Answer, lambda answer: answer.request == "f").error
        assert refused.code == "other_program"
        with cpp_program(port) as again:
            session.hear(child_messages.Attached, state("following"))
            session.hear(child_messages.Held)  # its breakpoints are there again
            again.kill()
            again.wait()
            with cpp_program(port, XML.replace('name="hey"', 'name="ho"')):
                over = session.hear(child_messages.Finished)
                assert "started again" in over.message


def test_a_program_that_does_not_answer_is_a_fault_with_a_hint(tmp_path: Path) -> None:
    with following(tmp_path, free_port()) as session:
        fault = session.hear(child_messages.Fault)
        assert "No answer of tcp://127.0.0.1" in fault.message
        assert "Groot2Publisher" in fault.hint


def test_a_program_of_groot_1_is_named(tmp_path: Path) -> None:
    port = free_port()
    with wrong_publisher(port, lambda _: [b"\x01\x02"]), following(tmp_path, port) as session:
        assert "Groot 1" in session.hear(child_messages.Fault).message


def test_a_tree_of_4000_nodes_is_shown(tmp_path: Path) -> None:
    leaves = "".join("<AlwaysSuccess/>" for _ in range(3999))
    xml = (
        f'<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>{leaves}</Sequence></BehaviorTree></root>'
    )
    port = free_port()
    tree = Tree.from_xml(xml)
    with Groot2Publisher(tree, port), following(tmp_path, port) as session:
        assert len(session.hear(child_messages.Tree).nodes) == 4000
        session.hear(child_messages.ApplicationReady)

        def is_whole(tick: Any) -> bool:
            tree.tick_exactly_once()
            return len(tick.past) >= 3999

        past = session.hear(child_messages.Tick, is_whole).past
        assert {status for _, status in past} == {"SUCCESS"}


@pytest.mark.parametrize("seed", seeds("groot_hostile_programs", 0))
def test_any_answers_of_a_hostile_program_are_dropped_or_told(tmp_path: Path, seed: int) -> None:
    """The tree is well-formed; statuses, blackboards and transitions are any bytes, or an error."""
    chosen = random.Random(seed)  # noqa: S311 - reproducible
    document = document_of(Tree.from_xml(XML))
    asked = 0

    def answer(parts: list[bytes]) -> list[bytes]:
        nonlocal asked
        asked += 1
        header = parts[0] + bytes(16)
        if parts[0][1:2] == b"T":
            return [header, document]
        if asked < 6:
            return [header, struct.pack("<HB", 1, 1)] if parts[0][1:2] == b"S" else [header, b"\x80"]
        anything = chosen.randbytes(chosen.randrange(40))
        return chosen.choice(
            [[header, anything], [anything], [b"error", anything], [header, anything, anything]]
        )

    port = free_port()
    with wrong_publisher(port, answer), following(tmp_path, port) as session:
        session.hear(child_messages.ApplicationReady)
        session.tell(child_messages.BeginRecording("run1"))
        session.tell(child_messages.Control(on=True, request="c"))
        session.hear(child_messages.Answer, lambda said: said.request == "c")
        session.hear(child_messages.Attached, lambda told: told.dropped > 0 or told.problem != "")
        end_s = time.monotonic() + DEADLINE_S
        while asked < 24:
            assert session.thread.is_alive()
            assert time.monotonic() < end_s
            session.channel.receive(0.05)
