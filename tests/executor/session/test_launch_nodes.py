"""Launch nodes: real processes beside fake children."""

from __future__ import annotations

import base64
import io
import os
import signal
import zipfile
from dataclasses import replace
from typing import Any

import psutil

from executor.child_messages import ExpectNavigators
from executor.launching.model import LaunchPlan, NodeSpec
from executor.session.events import ChildExited, Retire, Spawn, Tell, Unpacked
from executor.session.ladder import State
from executor.session.launch_nodes import LaunchNodes
from tests.executor.manager.test_server import manager
from tests.executor.session.play import Play
from tests.executor.session_client import SessionClient
from tests.processes import with_word

TALKER = "import sys, time\nprint('hello from', sys.argv[1], flush=True)\ntime.sleep(3600)\n"
LAUNCH = """
launch:
  - node: {exec: launch/talker.py, name: talker, args: one}
  - node: {pkg: ghosts, exec: ghost}
"""


def run_with(launch, **files):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("launch/extra.launch.yaml", launch)
        for name, text in files.items():
            archive.writestr(f"launch/{name}.py", text)
    app = base64.b64encode(packed.getvalue()).decode()
    return {"universe": {"universe": "x"}, "application": {"app_zip_base64": app}}


def processes_of(word):
    return with_word(word, psutil.Process().children(recursive=True))


async def test_nodes_live_with_the_application_and_are_listed_with_their_output():
    async with manager() as it:
        client = await SessionClient(it.port).open()
        assert await client.ask("run", run_with(LAUNCH, talker=TALKER)) == "ack"
        talker, ghost = client.named("launch_nodes")[0]["nodes"]
        assert (talker["name"], talker["state"], talker["line"]) == ("talker", "running", 3)
        assert (ghost["state"], "'ghosts'" in ghost["end"]) == ("failed", True)
        line = await client.event("log", lambda d: d["text"] == "hello from one")
        assert (line["data"]["source"], line["data"]["launch_node"]) == ("launch", talker["id"])
        viewer = await SessionClient(it.port).open()
        assert viewer.named("snapshot")[0]["launch_nodes"] == client.named("launch_nodes")[-1]["nodes"]
        await viewer.close()

        at = len(client.events)
        [process] = processes_of("talker.py")
        os.kill(process.pid, signal.SIGKILL)
        fault = (await client.event("fault", after=at))["data"]
        assert fault["message"].startswith("The node talker was ended at once")
        assert (fault["file"], fault["line"]) == ("launch/extra.launch.yaml", 3)
        assert client.state == "application_running"
        assert (await client.ask("restart_node", {"id": ghost["id"]}))["code"] == "unknown_node"
        at = len(client.events)
        assert await client.ask("restart_node", {"id": talker["id"]}) == "ack"
        await client.event("log", lambda d: d["text"] == "hello from one", after=at)

        assert await client.ask("disconnect") == "ack"
        assert client.named("launch_nodes")[-1]["nodes"][0]["state"] == "ended"
        assert processes_of("talker.py") == []
        await client.close()


PUBLISHER = """import rclpy
from geometry_msgs.msg import Twist
rclpy.init()
node = rclpy.create_node("publisher")
publisher = node.create_publisher(Twist, "/other", 1)


def publish():
    twist = Twist()
    twist.linear.x = 1
    publisher.publish(twist)


node.create_timer(0.1, publish)
rclpy.spin(node)
"""


async def test_a_wrong_field_of_a_message_is_said_with_its_place_and_remedy():
    sentence = "geometry_msgs/Vector3.x takes a float, not the int 1: write 1.0"
    async with manager() as it:
        client = await SessionClient(it.port).open()
        launch = "launch:\n  - node: {exec: launch/publisher.py, name: publisher}\n"
        assert await client.ask("run", run_with(launch, publisher=PUBLISHER)) == "ack"
        fault = (await client.event("fault"))["data"]
        assert fault["message"] == f"The node publisher ended with exit code 1: {sentence}."
        assert (fault["file"], fault["line"]) == ("launch/publisher.py", 10)
        assert f"launch/publisher.py:10: {sentence}" in [log["text"] for log in client.named("log")]
        await client.close()


async def test_a_launch_file_that_cannot_be_read_is_reported_with_its_line():
    async with manager() as it:
        client = await SessionClient(it.port).open()
        reply = await client.ask("run", run_with("launch:\n  - nod: {exec: x}\n"))
        assert reply["code"] == "bad_launch_file"
        assert reply["message"].startswith("launch/extra.launch.yaml:2:10: there is no action 'nod'")
        fault = client.named("fault")[-1]
        assert (fault["kind"], fault["file"], fault["line"]) == ("load", "launch/extra.launch.yaml", 2)
        await client.close()


NODE = NodeSpec("a", "a", "", "a.py", "launch/a.launch.yaml", 1, ("python", "a.py"))


class NodePlay(Play):
    """A play whose application has a launch node."""

    node = NODE

    def answers(self, effect):
        answers = super().answers(effect)
        plan = LaunchPlan((self.node,))
        return [Unpacked(a.token, a.folder, plan=plan) if isinstance(a, Unpacked) else a for a in answers]

    def states(self):
        return [node.state for node in self.sent("launch_nodes")[-1].nodes]


def test_a_node_is_started_with_the_application_and_ended_with_it():
    for end in ("terminate_application", "disconnect", None):
        play = NodePlay()
        play.command("run")
        assert "node" in play.did(Spawn)
        assert play.states() == ["running"]
        if end is None:
            play.child_dies("application")
        else:
            assert play.reply(play.command(end)) == "ack"
        assert play.states() == ["ended"]
        assert play.did(Retire).count("node") == 1
        assert play.session.children.leaving == set()


def test_a_second_run_starts_it_again_and_a_pause_does_not_affect_it():
    play = NodePlay()
    play.command("run")
    play.command("pause")
    assert play.states() == ["running"]
    play.command("run")
    assert (play.did(Spawn).count("node"), play.did(Retire).count("node")) == (2, 1)
    assert play.states() == ["running"]
    assert play.reply(play.command("restart_node", id="a")) == "ack"
    assert play.did(Spawn).count("node") == 3
    assert play.sent("launch_nodes")[-1].nodes[0].restarts == 1
    assert play.state is State.APPLICATION_RUNNING


class NavigatorPlay(NodePlay):
    """A play whose launch node may navigate."""

    node = replace(NODE, may_navigate=True)

    def expected(self) -> list[list[str]]:
        messages = [effect.message for effect in self.effects if isinstance(effect, Tell)]
        return [message.names for message in messages if isinstance(message, ExpectNavigators)]


def test_the_world_is_notified_of_nodes_that_may_navigate_and_of_their_ends() -> None:
    play = NavigatorPlay()
    play.command("run")
    assert play.expected() == [["a"]]
    play.command("restart_node", id="a")
    assert play.expected() == [["a"], ["a"]]
    node = [effect.number for effect in play.effects if isinstance(effect, Spawn) and effect.kind == "node"]
    play.happens(ChildExited("node", node[-1], "ended with exit code 0"))
    assert play.expected() == [["a"], ["a"], []]
    play.command("run")
    assert play.expected() == [["a"], ["a"], [], ["a"]]
    play.node = NODE
    play.command("run")
    assert play.expected()[4:] == [[]]
    play.command("run")
    assert play.expected()[5:] == []


def test_a_node_that_no_launch_file_has_is_not_restarted() -> None:
    stage: Any = None
    assert (
        LaunchNodes().restart(stage, "launch/x.yaml:y") == "The launch files have no node 'launch/x.yaml:y'."
    )
