"""The debugger of the application, in a session with the real process and a fake world."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from executor import child_messages, messages
from executor.application.debugging import ApplicationDebugger
from tests.executor.application.real_application import action, app, run_data, session
from tree_gardener import Tree
from tree_gardener.runner import Runner

COUNT = action("""
def initialise(self):
    print("begins", self.name)
def update(self):
    print("ticks", self.name)
    return Status.RUNNING if self.name == "last" else Status.SUCCESS
""")
TREE = (
    "<Sequence name='all' _bts_id='s'><Script code='n := 1' _bts_id='w'/>"
    "<Act name='first' _bts_id='a'/><Act name='last' _bts_id='b'/></Sequence>"
)
UIDS = {"all": 1, "w": 2, "a": 3, "b": 4}


def at(node_id, **more):
    return {"tree_id": "Main", "node_id": node_id, **more}


async def begin(client, *breakpoints, **more):
    assert await client.ask("set_breakpoints", {"breakpoints": list(breakpoints)}) == "ack"
    assert await client.ask("run", run_data(app(COUNT, TREE), **more)) == "ack"


async def held_at(client, node_id, after=0):
    return (await client.event("held", lambda d: d["uid"] == UIDS[node_id], after=after))["data"]


def lines(client):
    return [log["text"] for log in client.named("log") if log["source"] == "action"]


async def test_a_breakpoint_holds_the_first_tick_and_a_step_continues_within_it():
    async with session() as client:
        await begin(client, at("a"))
        held = await held_at(client, "a")
        await client.comes_to("held")
        assert (held["path"], held["ahead"], held["event"], held["cause"]) == (
            [1, 3],
            [3, 4],
            "before",
            "breakpoint",
        )
        assert (held["hook"], held["tick"]) == (0, 1)
        await client.event("blackboard", lambda d: any(e["key"] == "n" for e in d["entries"]))
        assert lines(client) == []
        assert [1, "RUNNING"] in held["statuses"]
        place = len(client.events)
        assert await client.ask("step_over") == "ack"
        after = await held_at(client, "a", place)
        assert (after["event"], after["status"], after["hook"], after["cause"]) == (
            "after",
            "SUCCESS",
            1,
            "step",
        )
        assert lines(client) == ["begins first", "ticks first"]
        assert client.state == "held", "time does not pass between the steps of one tick"
        assert client.named("state-changed", after=place) == []
        assert await client.ask("step_into") == "ack"
        assert (await held_at(client, "b", place))["event"] == "before"
        assert await client.ask("continue_run") == "ack"
        await client.event("tick", lambda d: d["n"] > 3, after=place)
        await client.comes_to("application_running")


async def test_a_step_out_of_the_tick_lets_time_pass_and_stops_in_the_next_one():
    async with session() as client:
        await begin(client, at("b"))
        await held_at(client, "b")
        place = len(client.events)
        assert await client.ask("step_out") == "ack"
        held = (await client.event("held", after=place))["data"]
        assert (held["uid"], held["tick"]) == (1, 1)
        place = len(client.events)
        assert await client.ask("step_to", {"uid": 1, "path": "all"}) == "ack"
        held = (await client.event("held", after=place))["data"]
        assert (held["uid"], held["tick"], held["event"]) == (1, 2, "before")
        await client.comes_to("held")
        states = [s["state"] for s in client.named("state-changed", after=place)]
        assert states == ["application_running", "held"]


async def test_while_held_the_blackboard_is_written_and_results_are_forced():
    async with session() as client:
        await begin(client, at("a"))
        await held_at(client, "a")
        assert await client.ask("set_blackboard", {"scope": "", "key": "n", "value": 5}) == "ack"
        assert await client.ask("pause") == "ack"
        assert client.state == "held"
        first = {"uid": 3, "path": "first"}
        assert await client.ask("force", {**first, "status": "FAILURE"}) == "ack"
        [forced] = client.named("forced")
        assert forced["nodes"] == [
            {"uid": 3, "status": "FAILURE", "once": False, "after": False, "skips_to": 0}
        ]
        assert await client.ask("set_breakpoints", {"breakpoints": []}) == "ack"
        place = len(client.events)
        assert await client.ask("continue_run") == "ack"
        finished = (await client.event("finished", after=place))["data"]
        assert (finished["status"], lines(client)) == ("FAILURE", [])


async def test_breakpoints_that_are_set_while_the_program_is_restarted_hold_the_new_run():
    async with session() as client:
        await begin(client)
        await client.event("tick", lambda d: d["n"] > 3)
        await client.send("restart_application")
        assert await client.ask("set_breakpoints", {"breakpoints": [at("b")]}) == "ack"
        # The old run may hold, too, if it took them before its end.
        await client.event("held", lambda d: (d["uid"], d["tick"]) == (UIDS["b"], 1))


async def test_a_wrong_breakpoint_that_is_set_while_the_program_loads_is_named_and_left_out():
    async with session() as client:
        run = run_data(app("import time\ntime.sleep(2)\n" + COUNT, TREE))
        await client.send("run", run)
        await client.event("progress", lambda d: d["rung"] == "run_application")
        wanted = [at("a", condition="1 +"), at("b")]
        assert await client.ask("set_breakpoints", {"breakpoints": wanted}) == "ack"
        await held_at(client, "b")
        assert any("A breakpoint cannot be set" in log["text"] for log in client.named("log"))


DRIVES = action("""
def setup(self, node, **kwargs):
    from geometry_msgs.msg import Twist, Vector3
    self.fast = Twist(linear=Vector3(x=0.1))
    self.sends = node.create_publisher(Twist, "/cmd_vel", 10)
    self.hears = node.create_subscription(Twist, "/cmd_vel", self.heard, 100)
def heard(self, message):
    print("heard", message.linear.x)
def update(self):
    self.sends.publish(self.fast)
    return Status.RUNNING
""")


async def test_while_an_outside_robot_is_held_it_gets_zeros_and_no_callback_runs():
    async with session() as client:
        assert await client.ask("set_breakpoints", {"breakpoints": [at("n1", hits=5)]}) == "ack"
        run = run_data(app(DRIVES)) | {"universe": {"universe": "none"}}
        assert await client.ask("run", run) == "ack"
        assert (await client.event("held"))["data"]["outside"]
        await asyncio.sleep(0.5)  # the time is the test: zeros are sent ten times in a second
        assert "heard 0.0" not in lines(client)
        assert await client.ask("set_breakpoints", {"breakpoints": []}) == "ack"
        assert await client.ask("continue_run") == "ack"
        await client.event("log", lambda d: d["text"] == "heard 0.0")
        await client.event("log", lambda d: lines(client).count("heard 0.0") >= 3)


async def test_a_frozen_node_is_released_and_one_node_runs_alone():
    async with session() as client:
        await begin(client)
        await client.event("tick")
        first, last = {"uid": 3, "path": "first"}, {"uid": 4, "path": "last"}
        assert await client.ask("force", {**first, "status": "RUNNING"}) == "ack"
        assert await client.ask("force", {**last, "effect": "alone"}) == "ack"  # it never ends
        await client.event("forced", lambda d: d["alone"] == 4)
        refused = await client.ask("force", {**first, "effect": "skip_to", "path": "elsewhere"})
        assert refused["code"] == "unknown_node"
        refused = await client.ask("force", {"uid": 1, "path": "all", "effect": "alone"})
        assert refused["code"] == "not_forced"
        assert await client.ask("release") == "ack"
        forced = (await client.event("forced", lambda d: not d["nodes"] and not d["alone"]))["data"]
        assert forced == {"nodes": [], "alone": 0}


async def test_a_held_run_is_ended_and_a_wrong_breakpoint_changes_nothing():
    async with session() as client:
        await begin(client, at("a"))
        await held_at(client, "a")
        wrong = await client.ask("set_breakpoints", {"breakpoints": [at("b", condition="n := 2")]})
        assert wrong["code"] == "bad_breakpoint"
        assert "may only read" in wrong["message"]
        place = len(client.events)
        assert await client.ask("terminate_application") == "ack"
        assert client.state == "visualization_ready"
        assert (await client.event("finished", after=place))["data"]["reason"] == "terminated"
        assert client.named("fault") == []
        place = len(client.events)
        assert await client.ask("restart_application") == "ack"
        await held_at(client, "a", place)
        assert await client.ask("disconnect") == "ack"


async def test_a_step_of_a_paused_run_is_held_and_conditions_count():
    async with session() as client:
        await begin(client)
        await client.event("tick")
        assert await client.ask("pause") == "ack"
        counted = at("b", condition="n == 1", hits=2)
        logs = at("b", log="n is {n}")
        assert await client.ask("set_breakpoints", {"breakpoints": [counted, logs]}) == "ack"
        assert await client.ask("step") == "ack"
        assert client.state == "paused"
        assert await client.ask("step") == "ack"
        await held_at(client, "b")
        await client.comes_to("held")
        assert "last: n is 1" in lines(client)
        assert await client.ask("set_breakpoints", {"breakpoints": [counted], "on": False}) == "ack"
        place = len(client.events)
        assert await client.ask("continue_run") == "ack"
        await client.event("tick", lambda d: d["n"] > 6, after=place)


class Host:
    """A process for the debugger, which continues at each stop."""

    def __init__(self):
        self.inputs = []
        self.orders = []
        self.debugger: ApplicationDebugger | None = None

    def serve_held(self):
        assert self.debugger is not None
        for order in self.orders.pop(0) if self.orders else [child_messages.Continue()]:
            assert self.debugger.obey(order) is None

    def show_held(self):
        pass

    def note_input(self, command, data, tick, hook):
        self.inputs.append((command, json.loads(json.dumps(data)), tick, hook))


def small():
    tree = Tree.from_xml(
        "<root BTCPP_format='4'><BehaviorTree ID='M'><Sequence name='s'><AlwaysSuccess name='x'/>"
        "<AlwaysSuccess name='y'/></Sequence></BehaviorTree></root>"
    )
    tree.setup()
    sent: list[Any] = []
    host = Host()
    debugger = host.debugger = ApplicationDebugger(Runner(tree, tick_hz=10), sent.append, host)
    return tree, host, sent, debugger


def test_what_is_forced_is_noted_with_its_place_in_the_tick():
    tree, host, sent, debugger = small()
    stop_at_all = [messages.Breakpoint("M", key) for key in ("x", "y")]
    debugger.start(messages.SetBreakpoints(stop_at_all))
    force = child_messages.ForceResult(force=messages.Force(3, "y", status="FAILURE", once=True))
    host.orders = [[child_messages.Continue()], [force, child_messages.Continue()]]
    assert tree.tick_exactly_once().name == "FAILURE"
    debugger.between_ticks()
    assert [(name, tick, hook) for name, _, tick, hook in host.inputs] == [
        ("hold", 1, 0),
        ("hold", 1, 1),
        ("force", 1, 1),
    ]
    assert host.inputs[0][1] == {
        "uid": 2,
        "path": "x",
        "event": "before",
        "why": "breakpoint 1 before its tick",
    }
    kinds = [type(message).__name__ for message in sent]
    assert kinds == ["Held", "Released", "Held", "Forced", "Released", "Forced"]
    assert debugger.take_held_s() >= 0
    assert debugger.take_held_s() == 0
    assert debugger.obey(child_messages.ReleaseForced()) is None
    assert len(host.inputs) == 3, "nothing was forced any more"


def test_breakpoints_that_the_tree_refuses_are_named_and_left_out():
    tree, host, sent, debugger = small()
    wrong = messages.Breakpoint("M", "x", condition="1 +")
    debugger.start(messages.SetBreakpoints([wrong, messages.Breakpoint("M", "y")]))
    assert sent[0].text.startswith("A breakpoint cannot be set: in the condition '1 +'")
    tree.tick_exactly_once()
    assert [message.uid for message in sent if isinstance(message, child_messages.Held)] == [3]
    assert [name for name, *_ in host.inputs] == ["hold"]


def test_nothing_asks_any_more_once_nothing_is_set():
    tree, _, _, debugger = small()
    debugger.obey(
        child_messages.SetBreakpoints(wanted=messages.SetBreakpoints([messages.Breakpoint("M", "x")]))
    )
    tree.tick_exactly_once()
    debugger.between_ticks()
    assert debugger.obey(child_messages.Continue()).code == "not_held"
    debugger.obey(child_messages.SetBreakpoints(wanted=messages.SetBreakpoints([])))
    debugger.between_ticks()
    assert tree.entry_of(tree.nodes[0], len) is len
    assert debugger.place == (1, -1)
