"""Trees that a server in another process runs by name, asked for by real action clients."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import pytest

from tests.domains import own_domain_id
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.zmtp import Groot2
from tests.tree_gardener.programs import Peer, program
from tree_gardener.ros_server import CANCELLED, FINISHED, PREEMPTED, SHUT_DOWN

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

pytestmark = [
    pytest.mark.timeout(180),
    pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"),
]

DOMAIN_ID = own_domain_id()
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
TREES = """
<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main"><AlwaysSuccess/></BehaviorTree>
  <BehaviorTree ID="Fails"><AlwaysFailure/></BehaviorTree>
  <BehaviorTree ID="Endless"><KeepRunningUntilFailure><Mark/></KeepRunningUntilFailure></BehaviorTree>
  <BehaviorTree ID="Checks">
    <ScriptCondition code="speed == 0.5 &amp;&amp; place == 'kitchen'"/>
  </BehaviorTree>
  <BehaviorTree ID="Typed"><Delay delay_msec="{wait}"><AlwaysSuccess/></Delay></BehaviorTree>
  <BehaviorTree ID="Throws"><Breaks/></BehaviorTree>
  <Code><Action name="Mark"/><Action name="Breaks"/></Code>
</root>
"""
MARK = """
import pathlib

import py_trees
from std_msgs.msg import String


class Mark(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        node = kwargs["node"]
        node.declare_parameter("gain", 2.0)
        self.publisher = node.create_publisher(String, "/marks", 10)
        pathlib.Path("marks").open("a").write(f"setup {len(list(node.publishers))}\\n")

    def update(self):
        return py_trees.common.Status.RUNNING

    def terminate(self, status):
        pathlib.Path("marks").open("a").write("halted\\n")
"""
BREAKS = """
import py_trees


class Breaks(py_trees.behaviour.Behaviour):
    def update(self):
        raise ValueError("no arm")
"""


class Client:
    """Sends goals to the server."""

    def __init__(self, peer: Peer, folder: Path) -> None:
        from btcpp_ros2_interfaces.action import ExecuteTree
        from rclpy.action import ActionClient

        self.peer = peer
        self.folder = folder
        self.kind = ExecuteTree
        self.told: list[str] = []
        self.client = ActionClient(peer.node, ExecuteTree, "bt_execution")
        peer.until(self.client.server_is_ready)
        handle = peer.insist(lambda: self.client.send_goal_async(self.kind.Goal(target_tree="None")))
        peer.insist(handle.get_result_async)

    def send(self, tree: str, payload: str = "") -> Any:
        """Sends a goal; returns its handle."""
        goal = self.kind.Goal(target_tree=tree, payload=payload)
        return self.peer.answer(
            self.client.send_goal_async(goal, lambda message: self.told.append(message.feedback.message))
        )

    def result(self, handle: Any) -> tuple[int, int, str]:
        """Returns the status of the goal, that of the tree, and the message."""
        answer = self.peer.answer(handle.get_result_async())
        return answer.status, answer.result.node_status.status, answer.result.return_message

    def run(self, tree: str, payload: str = "") -> tuple[int, int, str]:
        return self.result(self.send(tree, payload))

    def marks(self) -> list[str]:
        file = self.folder / "marks"
        return file.read_text().splitlines() if file.is_file() else []

    def said(self) -> str:
        return (self.folder / "said").read_text()

    def is_running(self) -> bool:
        return any("Mark" in word for word in self.told)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("server")


@pytest.fixture(scope="module")
def peer() -> Iterator[Peer]:
    made = Peer(DOMAIN_ID)
    yield made
    made.close()


@pytest.fixture
def serve(folder: Path, peer: Peer) -> Iterator[Any]:
    """Starts a server; gives a client of it."""
    from contextlib import ExitStack

    (folder / "tree.xml").write_text(TREES)
    (folder / "marks").unlink(missing_ok=True)
    (folder / "actions").mkdir(exist_ok=True)
    (folder / "actions" / "Mark.py").write_text(MARK)
    (folder / "actions" / "Breaks.py").write_text(BREAKS)
    with ExitStack() as stack:

        def start(*words: str) -> Client:
            call = f"serve_trees('tree.xml', node_name='served', actions='actions', args={list(words)})"
            stack.enter_context(program(folder, DOMAIN_ID, call))
            client = Client(peer, folder)
            stack.callback(client.client.destroy)
            return client

        yield start


def test_clients_of_tree_execution_server_know_the_messages() -> None:
    assert FINISHED == "Tree finished with status: "
    assert CANCELLED == "Action Server canceling and halting Behavior Tree"


def test_trees_run_by_name_with_the_results_of_tree_execution_server(serve: Any) -> None:
    client = serve()
    assert client.run("Main") == (SUCCEEDED, 2, f"{FINISHED}SUCCESS")
    assert client.run("") == (SUCCEEDED, 2, f"{FINISHED}SUCCESS"), "the main tree"
    assert client.run("Fails") == (ABORTED, 3, f"{FINISHED}FAILURE")
    assert client.told[0] == "tick 1: no node is RUNNING"

    status, node_status, message = client.run("Nowhere")
    assert (status, node_status) == (ABORTED, 0)
    assert message.startswith("Behavior Tree exception: ")
    assert "there is no tree 'Nowhere'" in message
    assert "Endless" in message, "it names those that there are"

    status, node_status, message = client.run("Throws")
    assert (status, node_status) == (ABORTED, 3)
    assert "no arm" in message
    assert "Breaks" in message
    assert "Traceback" in client.said(), "for the author of the action"


def test_groot2_follows_the_tree_that_runs(serve: Any) -> None:
    port = free_port()
    client = serve(f"--groot2_port={port}")
    seen = []
    for tree in ("Main", "Fails"):
        client.run(tree)
        groot = Groot2.as_soon_as_served(port)
        seen.append(groot.ask("T")[0])
        groot.close()
    assert [b'ID="Main"' in seen[0], b'ID="Fails"' in seen[1]] == [True, True]
    assert f"at 127.0.0.1:{port}" in client.said()


def test_the_payload_is_on_the_blackboard(serve: Any) -> None:
    client = serve()
    assert client.run("Checks", '{"speed": 0.5, "place": "kitchen"}')[0] == SUCCEEDED
    assert client.run("Checks", '{"speed": 0.4, "place": "kitchen"}')[0] == ABORTED
    assert client.run("Typed", '{"wait": 1}')[0] == SUCCEEDED
    assert client.run("Main", '"any text"')[0] == SUCCEEDED

    assert client.run("Main", "any text")[0] == ABORTED
    assert "the payload is not JSON" in client.run("Main", "any text")[2]
    message = client.run("Main", '{"speed": 0.5,\n "place"}')[2]
    assert "the payload is not a JSON object" in message
    assert "line 2, column" in message
    assert "'a b'" in client.run("Main", '{"a b": 1}')[2]
    assert "null" in client.run("Main", '{"a": null}')[2]
    assert client.run("Typed", '{"wait": "soon"}')[0] == ABORTED, "no number"
    assert client.run("Typed", "")[0] == ABORTED, "no entry"
    assert client.run("Main")[0] == SUCCEEDED, "the server continues"


def test_cancelling_halts_the_tree_and_nothing_of_it_stays(serve: Any) -> None:
    client = serve()
    for _ in range(2):
        client.told.clear()
        handle = client.send("Endless")
        client.peer.until(client.is_running)
        client.peer.answer(handle.cancel_goal_async())
        assert client.result(handle) == (CANCELED, 1, CANCELLED)
    first, *rest = client.marks()
    assert first.startswith("setup ")
    assert rest == ["halted", first, "halted"], "the second tree finds the node as the first one did"


def test_a_new_goal_preempts(serve: Any) -> None:
    client = serve()
    first = client.send("Endless")
    client.peer.until(client.is_running)
    assert client.run("Main")[0] == SUCCEEDED
    assert client.result(first) == (ABORTED, 1, PREEMPTED)
    assert client.marks()[-1] == "halted"


def test_a_new_goal_waits_as_with_tree_execution_server(serve: Any) -> None:
    client = serve("--on_new_goal=queue")
    first = client.send("Endless")
    client.peer.until(client.is_running)
    second, third = client.send("Main"), client.send("Main")
    client.peer.answer(third.cancel_goal_async())
    assert client.result(third)[0] == CANCELED, "while it waits"
    client.peer.answer(first.cancel_goal_async())
    assert client.result(first)[0] == CANCELED
    assert client.result(second)[0] == SUCCEEDED


def test_a_new_goal_is_refused(serve: Any) -> None:
    client = serve("--on_new_goal=reject")
    first = client.send("Endless")
    client.peer.until(client.is_running)
    assert not client.send("Main").accepted
    client.peer.answer(first.cancel_goal_async())
    assert client.result(first)[0] == CANCELED
    assert client.run("Main")[0] == SUCCEEDED


def test_the_end_of_the_server_aborts_its_goal(folder: Path, peer: Peer, serve: Any) -> None:
    serve  # noqa: B018 - writes the files
    with program(
        folder, DOMAIN_ID, "serve_trees('tree.xml', node_name='served', actions='actions', args=[])"
    ) as process:
        client = Client(peer, folder)
        future = client.send("Endless").get_result_async()
        client.peer.until(client.is_running)
        process.terminate()
        answer = peer.answer(future)
        assert (answer.status, answer.result.return_message) == (ABORTED, SHUT_DOWN)
        process.wait(timeout=60)
    client.client.destroy()
    assert process.returncode == 0
    assert client.marks()[-1] == "halted"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ["--on_new_goal=never"],
            "on_new_goal is 'never', but has to be preempt, queue or reject (an argument)",
        ),
        (["--action_name="], "action_name is '', but has to be the name of an action (an argument)"),
        (["--on_finish=repeat"], "the argument '--on_finish=repeat' is not known"),
    ],
)
def test_a_wrong_parameter_is_said(
    words: list[str], said: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    from tree_gardener.ros_main import serve_trees

    assert serve_trees(tmp_path / "tree.xml", node_name="served", args=words) == 1
    assert said in capfd.readouterr().err
