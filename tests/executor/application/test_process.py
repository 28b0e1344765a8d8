"""The application process in a session: what actions may do, and how it is reported."""

from __future__ import annotations

import asyncio
import base64

import pytest

from tests.executor.application.real_application import (
    LIMITED,
    UPDATE_RUNNING,
    action,
    app,
    run_data,
    second_run_works,
    session,
)


async def test_a_run_is_reported_from_tree_to_finish():
    source = action("""
def setup(self, **kwargs):
    print("in setup")
def initialise(self):
    self.count = 0
def update(self):
    self.count += 1
    print("tick", self.count)
    return Status.SUCCESS if self.count == 3 else Status.RUNNING
def terminate(self, new_status):
    print("ends", new_status.name)
""")
    async with session() as client:
        assert await client.ask("run", run_data(app(source))) == "ack"
        finished = (await client.event("finished"))["data"]
        assert (finished["status"], finished["reason"]) == ("SUCCESS", "root_finished")
        await client.event("state-changed", lambda d: d["state"] == "visualization_ready" and d["reason"])
        (tree,) = client.named("tree")
        assert tree["nodes"][0] | {"kind": ""} == {
            "uid": 1,
            "parent": 0,
            "type": "Act",
            "kind": "",
            "name": "Act",
            "path": tree["nodes"][0]["path"],
            "node_id": "n1",
            "tree_id": "Main",
        }
        logs = [(log["text"], log["node_id"]) for log in client.named("log") if log["source"] == "action"]
        assert logs == [(text, "n1") for text in ("in setup", "tick 1", "tick 2", "tick 3", "ends SUCCESS")]
        ticks = client.named("tick")
        assert ticks[0]["changed"] == [[1, "RUNNING"]]
        assert await client.ask("restart_application") == "ack"
        await client.event("finished", after=len(client.events))


async def test_pause_step_resume_and_the_blackboard():
    source = """
import py_trees
from tree_gardener.ports import Port, get_input, set_output


class Act(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"gain": Port(int, default=1)}
    OUTPUT_PORTS = {"count": Port(int)}

    def update(self):
        self.count = getattr(self, "count", 0) + get_input(self, "gain")
        set_output(self, "count", self.count)
        return py_trees.common.Status.RUNNING
"""
    async with session() as client:
        tree = "<Act _bts_id='n1' count='{count}' gain='{gain}'/>"
        tree = f"<Sequence><Script code='gain := 1; pace := 0.5'/>{tree}</Sequence>"
        assert await client.ask("run", run_data(app(source, tree))) == "ack"
        await client.event("blackboard", lambda d: any(e["key"] == "count" for e in d["entries"]))
        assert await client.ask("pause") == "ack"
        # The acknowledgement follows the last tick: both come on the channel of the application.
        at = len(client.events)
        before = client.named("tick")[-1]["n"]
        await asyncio.sleep(0.3)  # the time is the test: several periods, in each of which a tick would come
        assert client.named("tick", after=at) == []
        assert await client.ask("step") == "ack"
        stepped = (await client.event("tick", after=at))["data"]["n"]
        assert stepped > before  # ticks before the pause that changed nothing may not have been reported
        counts = [e["value"] for b in client.named("blackboard") for e in b["entries"] if e["key"] == "count"]
        assert counts[-1] == stepped  # one at each tick
        assert await client.ask("set_blackboard", {"scope": "", "key": "gain", "value": 100}) == "ack"
        assert await client.ask("step") == "ack"
        entries = [e for b in client.named("blackboard") for e in b["entries"]]
        assert {"key": "gain", "value": 100}.items() <= [e for e in entries if e["key"] == "gain"][-1].items()
        assert [e for e in entries if e["key"] == "count"][-1]["value"] == stepped + 100
        bad = await client.ask("set_blackboard", {"scope": "nowhere", "key": "gain", "value": 1})
        assert bad["code"] == "bad_data"
        bad = await client.ask("set_blackboard", {"scope": "", "key": "count", "value": "many"})
        assert bad["message"] == "The entry 'count' holds a whole number: 'many' is not a whole number."
        at = len(client.events)
        assert await client.ask("set_blackboard", {"scope": "", "key": "pace", "value": 2}) == "ack"
        pace = (await client.event("blackboard", after=at))["data"]["entries"][0]
        assert (pace["type"], pace["value"]) == ("double", 2.0), "a double stays one"
        assert await client.ask("set_tick_rate", {"tick_hz": 40.0}) == "ack"
        assert await client.ask("resume") == "ack"
        await client.event("tick", lambda d: d["n"] > before + 5, after=at)


async def test_a_port_is_changed_while_it_runs():
    source = """
import py_trees
from tree_gardener.ports import Port, get_input, set_output


class Act(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"gain": Port(int, default=1)}
    OUTPUT_PORTS = {"seen": Port(int)}

    def update(self):
        set_output(self, "seen", get_input(self, "gain"))
        return py_trees.common.Status.RUNNING
"""

    def has_seen(number):
        return lambda d: any((e["key"], e["value"]) == ("seen", number) for e in d["entries"])

    async with session() as client:
        tree = "<Act name='act' _bts_id='n1' gain='1' seen='{seen}'/>"
        assert await client.ask("run", run_data(app(source, tree))) == "ack"
        await client.event("blackboard", has_seen(1))
        change = {"node_id": "n1", "path": "act", "port": "gain", "value": "7"}
        assert await client.ask("set_port", change) == "ack"
        await client.event("blackboard", has_seen(7))
        [changed] = client.named("port_set")
        assert (changed["value"], changed["saved"], changed["effect"]) == ("7", "1", "next_tick")
        bad = await client.ask("set_port", {**change, "value": "many"})
        assert (bad["code"], bad["hint"]) == ("bad_port", "Write a literal of that type, or a {key}.")
        assert await client.ask("pause") == "ack"
        assert await client.ask("set_port", {**change, "value": None}) == "ack", "also while paused"
        at = len(client.events)
        assert await client.ask("resume") == "ack"
        await client.event("blackboard", has_seen(1), after=at)


async def test_an_action_that_raises_ends_the_run_with_its_line():
    source = action("def update(self):\n    return 1 / 0")
    async with session() as client:
        await client.ask("run", run_data(app(source)))
        fault = (await client.event("fault"))["data"]
        assert (fault["kind"], fault["node_id"], fault["file"], fault["line"]) == (
            "exception",
            "n1",
            "actions/Act.py",
            7,
        )
        assert "ZeroDivisionError" in fault["traceback"]
        assert (await client.event("finished"))["data"]["reason"] == "action_raised"
        await second_run_works(client)


async def test_on_error_failure_continues_and_does_not_flood():
    source = action("def update(self):\n    raise ValueError('no')")
    async with session() as client:
        assert await client.ask("run", run_data(app(source), on_error="failure", on_finish="repeat")) == "ack"
        await client.event("tick", lambda d: d["n"] > 15)
        assert 1 <= len(client.named("fault")) <= 3
        assert client.state == "application_running"


@pytest.mark.parametrize(
    ("source", "line", "text"),
    [
        (action("def update(self)\n    return 1"), 6, "expected ':'"),
        ("import does_not_exist\n" + UPDATE_RUNNING, 1, "does_not_exist"),
        (UPDATE_RUNNING.replace("class Act(", "class Other("), 1, "no class Act"),
        (
            UPDATE_RUNNING + "    def setup(self, **kwargs):\n        raise OSError('no lidar')\n",
            9,
            "no lidar",
        ),
        ("import sys\nsys.exit(3)\n", 0, "sys.exit(3)"),
    ],
    ids=["syntax", "import", "class", "setup", "exit"],
)
async def test_an_application_that_does_not_load_reports_the_place(source, line, text):
    async with session() as client:
        reply = await client.ask("run", run_data(app(source)))
        assert reply["code"] == "load_failed"
        fault = client.named("fault")[0]
        assert text in fault["message"]
        if line:
            assert (fault["file"], fault["line"]) == ("actions/Act.py", line)
        assert client.state == "visualization_ready"
        await second_run_works(client)


@pytest.mark.parametrize(
    ("body", "kind", "text"),
    [
        ("import sys\nsys.exit(3)", "exception", "sys.exit(3)"),
        ("import os\nos._exit(7)", "process", "exit code 7"),
        ("import os\nos.kill(os.getpid(), 9)", "process", "ended at once"),
        ("import os\nwhile True: os.fork()", "exception", "forks"),
        ("hoard = []\nwhile True: hoard.append(bytearray(50_000_000))", "exception", "MemoryError"),
        ("open('big', 'wb').write(bytes(30_000_000))", "exception", "File too large"),
        ("import ctypes\nctypes.string_at(0)", "process", "crashed"),
    ],
    ids=["exit", "_exit", "kill", "forks", "memory", "file", "crash"],
)
async def test_actions_that_do_their_worst(body, kind, text):
    lines = "\n".join(f"    {line}" for line in body.split("\n"))
    async with session(*LIMITED) as client:
        await client.ask("run", run_data(app(action(f"def update(self):\n{lines}"))))
        fault = (await client.event("fault", lambda d: d["kind"] != "timeout"))["data"]
        assert fault["kind"] == kind, fault
        assert text in fault["message"] + fault["traceback"]
        if kind == "exception":
            assert fault["node_id"] == "n1"
        await client.event("state-changed", lambda d: d["state"] == "visualization_ready" and d["reason"])
        await second_run_works(client)


async def test_a_callback_that_raises_is_reported_with_its_node():
    source = """
import py_trees
from rosgraph_msgs.msg import Clock


class Act(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        kwargs["node"].create_subscription(Clock, "/clock", self.on_clock, 10)

    def on_clock(self, message):
        raise RuntimeError("bad scan")

    def update(self):
        return py_trees.common.Status.RUNNING
"""
    async with session() as client:
        await client.ask("run", run_data(app(source)))
        fault = (await client.event("fault"))["data"]
        assert (fault["kind"], fault["node_id"], fault["line"]) == ("exception", "n1", 11)
        assert (await client.event("finished"))["data"]["reason"] == "action_raised"


async def test_old_actions_run_unchanged():
    source = """
import py_trees
import geometry_msgs
import sensor_msgs
from cv_bridge import CvBridge
import tree_tools


class Act(py_trees.behaviour.Behaviour):
    def __init__(self, name, ports=None):
        super().__init__(name)
        self.ports = ports

    def setup(self, **kwargs):
        self.node = kwargs["node"]
        self.bridge = CvBridge()
        self.image = sensor_msgs.msg.Image()
        self.publisher = self.node.create_publisher(geometry_msgs.msg.Twist, "/cmd_vel", 10)

    def update(self):
        twist = geometry_msgs.msg.Twist()
        twist.linear.x = float(tree_tools.get_port_content(self.ports["speed"]))
        self.publisher.publish(twist)
        tree_tools.set_port_content(self.ports["said"], "yes")
        return py_trees.common.Status.RUNNING
"""
    async with session() as client:
        tree = "<Act speed='0.25' said='{said}'/>"
        assert await client.ask("run", run_data(app(source, tree))) == "ack"
        entry = (await client.event("blackboard"))["data"]["entries"][0]
        assert (entry["key"], entry["value"]) == ("said", "yes")
        await client.event("tick", lambda d: d["n"] > 5)
        await client.ask("pause")
        await client.event("log", lambda d: d["text"] == "cmd_vel 0.25")


async def test_simulated_time_is_the_time_of_the_node_and_of_delays():
    source = action("""
def setup(self, **kwargs):
    self.node = kwargs["node"]
def update(self):
    print("now", self.node.get_clock().now().nanoseconds / 1e9)
    return Status.SUCCESS
""")
    async with session() as client:
        tree = "<Delay delay_msec='300'><Act/></Delay>"
        assert await client.ask("run", run_data(app(source, tree))) == "ack"
        log = (await client.event("log", lambda d: d["source"] == "action"))["data"]
        assert 0.3 <= float(log["text"].split()[1]) < 3.0
        assert (await client.event("finished"))["data"]["status"] == "SUCCESS"


async def test_a_flood_of_prints_is_limited_and_the_session_stays_quick():
    source = action("""
def update(self):
    for n in range(20000):
        print(n)
    return Status.RUNNING
""")
    async with session() as client:
        assert await client.ask("run", run_data(app(source))) == "ack"
        await client.event("log", lambda d: "left out" in d["text"])
        assert await client.ask("pause") == "ack"
        assert len(client.named("log")) < 4000


@pytest.mark.parametrize("archive", ["", "!!!", base64.b64encode(b"no zip").decode()])
async def test_rubbish_in_place_of_an_application_is_refused(archive):
    async with session() as client:
        reply = await client.ask("run", run_data(archive))
        assert reply["code"] == "bad_archive"
        await second_run_works(client)
