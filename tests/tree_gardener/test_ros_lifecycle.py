"""A tree as a managed node in another process, driven by the services of the life cycle."""

from __future__ import annotations

import os
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import pytest

from tests.domains import own_domain_id
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.zmtp import Groot2
from tests.tree_gardener.programs import Peer, program
from tree_gardener.ros_lifecycle import LifecycleActionNode

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

pytestmark = [
    pytest.mark.timeout(180),
    pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"),
]

DOMAIN_ID = own_domain_id()
CONFIGURE, CLEANUP, ACTIVATE, DEACTIVATE, UNCONFIGURED_SHUTDOWN, ACTIVE_SHUTDOWN = 1, 2, 3, 4, 5, 7
UNCONFIGURED, INACTIVE, ACTIVE, FINALIZED = 1, 2, 3, 4
TREE = """
<root BTCPP_format="4"><BehaviorTree ID="T"><Mark/></BehaviorTree><Code><Action name="Mark"/></Code></root>
"""
MARK = """
import pathlib
import time

import py_trees


def note(word):
    pathlib.Path("marks").open("a").write(word + "\\n")


class Mark(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        kwargs["node"].declare_parameter("gain", 2.0)
        note("setup")

    def initialise(self):
        note("begin")

    def update(self):
        if pathlib.Path("break").exists():
            raise ValueError("no arm")
        done = pathlib.Path("done").exists()
        return py_trees.common.Status.SUCCESS if done else py_trees.common.Status.RUNNING

    def terminate(self, status):
        if pathlib.Path("slow").exists():
            pathlib.Path("slow").unlink()
            note("halting")
            time.sleep(0.5)  # requests come meanwhile
        note(status.name)

    def shutdown(self):
        note("shutdown")
"""


class Manager:
    """Asks for transitions, as `ros2 lifecycle` does."""

    def __init__(self, peer: Peer, folder: Path, name: str = "managed") -> None:
        from lifecycle_msgs.srv import ChangeState, GetState

        self.peer, self.folder = peer, folder
        self._change = peer.node.create_client(ChangeState, f"/{name}/change_state")
        self._state = peer.node.create_client(GetState, f"/{name}/get_state")
        self._kinds = ChangeState, GetState
        peer.until(lambda: self._change.service_is_ready() and self._state.service_is_ready())
        # A service is ready for the client before its server knows where to answer, so answers may be lost.
        peer.insist(self.ask_state)
        peer.insist(lambda: self.ask(0, label="no transition"))

    def ask(self, transition: int, label: str = "") -> Any:
        """Asks for a transition by its number, or by its label where it has one; returns the future."""
        request = self._kinds[0].Request()
        request.transition.id, request.transition.label = transition, label
        return self._change.call_async(request)

    def ask_state(self) -> Any:
        """Asks for the state; returns the future."""
        return self._state.call_async(self._kinds[1].Request())

    def change(self, transition: int) -> bool:
        """Asks for a transition; returns whether it succeeded."""
        return bool(self.peer.answer(self.ask(transition)).success)

    def begin(self) -> None:
        """Configures and activates the node."""
        assert self.change(CONFIGURE)
        assert self.state() == INACTIVE
        assert self.change(ACTIVATE)

    def state(self) -> int:
        """Returns the state."""
        return int(self.peer.answer(self.ask_state()).current_state.id)

    def marks(self) -> list[str]:
        file = self.folder / "marks"
        return file.read_text().splitlines() if file.is_file() else []

    def wait_for(self, mark: str) -> None:
        self.peer.until(lambda: mark in self.marks())

    def close(self) -> None:
        self.peer.node.destroy_client(self._change)
        self.peer.node.destroy_client(self._state)


@pytest.fixture(scope="module")
def peer() -> Iterator[Peer]:
    made = Peer(DOMAIN_ID)
    yield made
    made.close()


@pytest.fixture
def manage(tmp_path: Path, peer: Peer) -> Iterator[Any]:
    """Starts the node; gives its manager."""
    (tmp_path / "tree.xml").write_text(TREE)
    (tmp_path / "actions").mkdir()
    (tmp_path / "actions" / "Mark.py").write_text(MARK)
    with ExitStack() as stack:

        def start(*words: str) -> Manager:
            call = f"manage_tree('tree.xml', node_name='managed', actions='actions', args={list(words)})"
            stack.enter_context(program(tmp_path, DOMAIN_ID, call))
            manager = Manager(peer, tmp_path)
            stack.callback(manager.close)
            return manager

        yield start


def test_the_states_load_tick_halt_and_close(manage: Any) -> None:
    manager = manage()
    assert (manager.state(), manager.marks()) == (UNCONFIGURED, [])
    assert manager.change(CONFIGURE)
    assert (manager.state(), manager.marks()) == (INACTIVE, ["setup"])
    for runs in (1, 2):
        assert manager.change(ACTIVATE)
        manager.peer.until(lambda runs=runs: manager.marks().count("begin") == runs)
        assert manager.state() == ACTIVE
        assert manager.change(DEACTIVATE)
        assert manager.state() == INACTIVE
    assert manager.marks() == ["setup", "begin", "INVALID", "begin", "INVALID"]
    assert manager.change(CLEANUP)
    assert (manager.state(), manager.marks()[-1]) == (UNCONFIGURED, "shutdown")

    assert manager.change(CONFIGURE), "the parameter of the action was undeclared"
    assert manager.change(ACTIVATE)
    manager.peer.until(lambda: manager.marks().count("begin") == 3)
    assert manager.change(ACTIVE_SHUTDOWN)
    assert manager.state() == FINALIZED
    assert manager.marks()[-2:] == ["INVALID", "shutdown"]


def test_groot2_follows_the_configured_tree(manage: Any) -> None:
    port = free_port()
    manager = manage(f"--groot2_port={port}")
    assert manager.change(CONFIGURE)
    groot = Groot2.as_soon_as_served(port)
    assert b"<Mark " in groot.ask("T")[0]
    groot.close()


def test_a_tree_that_ends_deactivates_the_node(manage: Any) -> None:
    manager = manage()
    assert manager.change(CONFIGURE)
    assert manager.change(ACTIVATE)
    manager.wait_for("begin")
    (manager.folder / "done").touch()
    manager.peer.until(lambda: manager.state() == INACTIVE)
    assert manager.change(ACTIVATE), "it begins again"
    manager.peer.until(lambda: manager.marks().count("begin") == 2)
    assert "the tree ended with SUCCESS" in (manager.folder / "said").read_text()


def test_an_error_of_an_action_is_processed(manage: Any) -> None:
    manager = manage()
    assert manager.change(CONFIGURE)
    assert manager.change(ACTIVATE)
    manager.wait_for("begin")
    (manager.folder / "break").touch()
    manager.peer.until(lambda: manager.state() == UNCONFIGURED)
    assert manager.marks()[-1] == "shutdown"
    assert "no arm" in (manager.folder / "said").read_text()
    (manager.folder / "break").unlink()
    assert manager.change(CONFIGURE)
    assert manager.change(ACTIVATE)
    assert manager.state() == ACTIVE


def test_what_cannot_be_loaded_stays_unconfigured(manage: Any) -> None:
    manager = manage()
    (manager.folder / "tree.xml").write_text(TREE.replace("<Mark/>", "<Nothing/>"))
    assert not manager.change(CONFIGURE)
    assert manager.state() == UNCONFIGURED
    assert "Nothing" in (manager.folder / "said").read_text()
    (manager.folder / "tree.xml").unlink()
    assert not manager.change(CONFIGURE)
    assert "tree.xml cannot be read" in (manager.folder / "said").read_text()
    (manager.folder / "tree.xml").write_text(TREE)
    assert manager.change(CONFIGURE)
    assert manager.change(CLEANUP)
    assert manager.change(UNCONFIGURED_SHUTDOWN)


@pytest.mark.parametrize(
    ("before", "refused"),
    [
        ([], [ACTIVATE, DEACTIVATE, CLEANUP, ACTIVE_SHUTDOWN, 99]),
        ([CONFIGURE], [CONFIGURE, DEACTIVATE, UNCONFIGURED_SHUTDOWN]),
        ([CONFIGURE, ACTIVATE], [ACTIVATE, CONFIGURE, CLEANUP]),
        ([UNCONFIGURED_SHUTDOWN], [CONFIGURE, ACTIVATE, CLEANUP, UNCONFIGURED_SHUTDOWN]),
    ],
    ids=["unconfigured", "inactive", "active", "finalized"],
)
def test_a_request_that_does_not_fit_the_state_is_refused_and_the_node_lives(
    manage: Any, before: list[int], refused: list[int]
) -> None:
    manager = manage()
    assert all(map(manager.change, before))
    state = manager.state()
    for transition in refused:
        assert not manager.change(transition)
        assert manager.state() == state
    said = (manager.folder / "said").read_text()
    assert said.count("is refused: the node is ") == len(refused)
    assert "Traceback" not in said


def test_a_request_that_comes_while_the_tree_is_halted_waits_for_that(manage: Any) -> None:
    manager = manage()
    (manager.folder / "slow").touch()
    assert manager.change(CONFIGURE)
    assert manager.change(ACTIVATE)
    manager.wait_for("begin")
    asked = [manager.ask(transition) for transition in (DEACTIVATE, DEACTIVATE, ACTIVATE)]
    assert [bool(manager.peer.answer(each).success) for each in asked] == [True, False, True]
    manager.peer.until(lambda: manager.marks().count("begin") == 2)
    assert manager.marks()[1:4] == ["begin", "halting", "INVALID"]


def test_a_node_without_a_tree_refuses_to_be_configured(peer: Peer) -> None:
    from rclpy.lifecycle import TransitionCallbackReturn

    node = LifecycleActionNode("empty", context=peer.context)
    assert node.trigger_configure() == TransitionCallbackReturn.FAILURE
    node.close()
