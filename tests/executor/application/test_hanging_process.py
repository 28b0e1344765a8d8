"""The application process that hangs: in a tick, while loading, without simulated time."""

from __future__ import annotations

import pytest

from tests.executor.application.real_application import (
    UPDATE_RUNNING,
    action,
    app,
    own_session,
    run_data,
    second_run_works,
    session,
)

HANGING = action("""
def update(self):
    print("hangs now")
    while True:
        pass
""")
STUBBORN = action("""
def update(self):
    print("hangs now")
    while True:
        try:
            while True:
                pass
        except BaseException:
            pass
""")


@pytest.mark.parametrize("command", ["pause", "terminate_application"])
@pytest.mark.parametrize("source", [HANGING, STUBBORN], ids=["hanging", "stubborn"])
async def test_a_tick_that_hangs_is_named_and_ended(command, source):
    async with session() as client:
        assert await client.ask("run", run_data(app(source))) == "ack"
        await client.event("log", lambda d: d["text"] == "hangs now")
        reply = await client.ask(command)
        assert reply == "ack" if command == "terminate_application" else reply["code"] == "tick_hangs"
        fault = client.named("fault")[0]
        assert fault["kind"] == "timeout"
        assert "Act" in fault["message"]
        if source is HANGING:
            assert (fault["node_id"], fault["file"]) == ("n1", "actions/Act.py")
            assert fault["line"] in {8, 9}
        await client.event("state-changed", lambda d: d["state"] == "visualization_ready" and d["reason"])
        await second_run_works(client)


async def test_a_hanging_tick_is_reported_without_a_command_and_run_replaces_it():
    async with session() as client:
        assert await client.ask("run", run_data(app(HANGING))) == "ack"
        fault = (await client.event("fault"))["data"]
        assert (fault["kind"], fault["node_id"], fault["file"]) == ("timeout", "n1", "actions/Act.py")
        assert "while True" in fault["traceback"] or "pass" in fault["traceback"]
        assert client.state == "application_running"
        await second_run_works(client)


REGEX = action("""
def update(self):
    import re
    print("hangs now")
    re.match(r"(a+)+$", "a" * 60 + "b")
    return Status.RUNNING
""")
SLEEPS_WITH_THE_LOCK = action("""
def update(self):
    import ctypes
    ctypes.PyDLL(None).sleep(20)
    return Status.RUNNING
""")


async def test_a_tick_that_holds_the_interpreter_is_named_and_the_application_ended():
    async with session() as client:
        tree = "<Sequence><Act _bts_id='n0' name='first'/><Act _bts_id='n1' name='second'/></Sequence>"
        source = REGEX.replace("print(", "if self.name == 'first': return Status.SUCCESS\n        print(")
        assert await client.ask("run", run_data(app(source, tree))) == "ack"
        fault = (await client.event("fault"))["data"]
        line = 1 + next(i for i, text in enumerate(source.split("\n")) if "re.match" in text)
        assert (fault["kind"], fault["file"], fault["line"]) == ("timeout", "actions/Act.py", line)
        assert fault["node_id"] == "n1", "of two nodes of one kind it is the one that is ticked"
        state = await client.event(
            "state-changed", lambda d: d["state"] == "visualization_ready" and d["reason"]
        )
        assert "did not answer for 8 s" in state["data"]["reason"]
        assert len(client.named("fault")) == 1
        await second_run_works(client)


async def test_a_sleep_that_holds_the_interpreter_is_named_too():
    async with own_session() as (_, client):
        assert await client.ask("run", run_data(app(SLEEPS_WITH_THE_LOCK))) == "ack"
        fault = (await client.event("fault"))["data"]
        assert (fault["kind"], fault["node_id"], fault["line"]) == ("timeout", "n1", 8)


@pytest.mark.parametrize(
    ("source", "line"),
    [
        ("import time\ntime.sleep(600)\n" + UPDATE_RUNNING, 2),
        (
            UPDATE_RUNNING + "    def setup(self, **kwargs):\n        import time\n        time.sleep(600)\n",
            10,
        ),
    ],
    ids=["import", "setup"],
)
async def test_an_action_that_never_loads_is_reported_and_ended(source, line):
    async with session() as client:
        reply = await client.ask("run", run_data(app(source)))
        assert reply["code"] == "process_died"
        (fault,) = client.named("fault")
        assert (fault["kind"], fault["file"], fault["line"]) == ("timeout", "actions/Act.py", line)
        assert client.state == "visualization_ready"
        await second_run_works(client)


async def test_an_action_that_computes_while_loading_is_reported_and_may_finish():
    body = "import time\nend = time.monotonic() + 12\nwhile time.monotonic() < end: pass\n"
    async with session() as client:
        assert await client.ask("run", run_data(app(body + UPDATE_RUNNING))) == "ack"
        (fault,) = client.named("fault")
        assert (fault["kind"], fault["file"], fault["line"]) == ("timeout", "actions/Act.py", 3)


DEAF = action("""
def setup(self, **kwargs):
    import os
    if not ONCE or not os.path.exists("MARK"):
        open("MARK", "w").close()
        node = kwargs["node"]
        for clock in [s for s in node.subscriptions if s.topic_name == "/clock"]:
            node.destroy_subscription(clock)
def update(self):
    return Status.RUNNING
""")


async def test_an_application_that_hears_no_time_is_started_again_once(tmp_path):
    source = DEAF.replace("ONCE", "True").replace("MARK", str(tmp_path / "mark"))
    async with session() as client:
        assert await client.ask("run", run_data(app(source))) == "ack"
        fault = (await client.event("fault"))["data"]
        assert "without simulated time" in fault["message"]
        assert "does not receive it" in fault["message"]
        await client.event("tick", lambda d: d["n"] > 3)
        assert client.state == "application_running"
        assert len(client.named("fault")) == 1


async def test_a_world_that_publishes_no_time_is_reported_and_finally_ended():
    async with own_session("--mute-after", "0.5") as (_, client):
        assert await client.ask("run", run_data(app(UPDATE_RUNNING))) == "ack"
        await client.event("state-changed", lambda d: d["state"] == "connected" and d["reason"])
        faults = client.named("fault")
        assert [f["kind"] for f in faults] == ["timeout", "timeout"]
        assert all("the simulated world does not publish it" in f["message"] for f in faults)
