"""Python breakpoints in a session: the real application, debugpy's adapter, and a fake world."""

from __future__ import annotations

import asyncio
import json
import time
from collections import Counter
from typing import Any

import psutil
import pytest

from executor.application.python.debugger import HOST
from executor.debug_adapter.framing import framed
from executor.manager.allowance import BURST, COSTS, RATE_HZ
from tests.budget import count
from tests.executor.application.real_application import action, app, own_session, run_data, session
from tests.processes import with_word

COUNT = action("""
def initialise(self):
    self.n = 0
def update(self):
    self.n += 1
    shown = {"n": self.n}
    if self.n > 1000:
        raise ValueError("too many")
    return self.status_now(shown)
def status_now(self, shown):
    return Status.RUNNING if shown["n"] < 10_000 else Status.SUCCESS
""")
LINES = COUNT.split("\n")
ADDS = LINES.index("        self.n += 1") + 1
FILE = "actions/Act.py"


class Debugger:
    """A small client of the Debug Adapter Protocol over a session."""

    def __init__(self, client: Any) -> None:
        self.client = client
        self.seq = 0

    async def sent(self, command: str, **arguments: Any) -> str:
        self.seq += 1
        message = {"seq": self.seq, "type": "request", "command": command, "arguments": arguments}
        return str(await self.client.ask("dap", {"message": message}))

    async def ask(self, command: str, **arguments: Any) -> dict[str, Any]:
        answer = await self.message_of(command, **arguments)
        assert answer["success"], answer.get("message") or answer
        return dict(answer.get("body") or {})

    async def message_of(self, command: str, **arguments: Any) -> dict[str, Any]:
        """Returns the whole answer to a request, also one that is refused."""
        at = len(self.client.events)
        assert await self.sent(command, **arguments) == "ack"
        seq = self.seq
        return await self.message(lambda m: m.get("request_seq") == seq, after=at)

    async def message(self, wanted: Any, after: int = 0) -> dict[str, Any]:
        event = await self.client.event("dap", lambda d: wanted(d["message"]), after=after)
        return dict(event["data"]["message"])

    async def event(self, name: str, after: int = 0) -> dict[str, Any]:
        return dict((await self.message(lambda m: m.get("event") == name, after)).get("body") or {})

    async def configure(self, *breakpoints: dict[str, Any], after: int = 0, filters: Any = ()) -> None:
        await self.event("initialized", after)
        found = await self.ask("setBreakpoints", source={"path": FILE}, breakpoints=list(breakpoints))
        assert all(each["verified"] for each in found["breakpoints"]), found
        await self.ask("setExceptionBreakpoints", filters=list(filters))
        await self.ask("configurationDone")

    async def top(self, stop: dict[str, Any]) -> dict[str, Any]:
        stack = await self.ask("stackTrace", threadId=stop["threadId"])
        return dict(stack["stackFrames"][0])

    async def locals(self, frame: dict[str, Any]) -> dict[str, Any]:
        scopes = await self.ask("scopes", frameId=frame["id"])
        reference = scopes["scopes"][0]["variablesReference"]
        found = await self.ask("variables", variablesReference=reference)
        return {each["name"]: each for each in found["variables"]}

    def messages(self, command: str) -> list[dict[str, Any]]:
        found = [each["message"] for each in self.client.named("dap")]
        return [each for each in found if each.get("command") == command]

    def events(self, name: str) -> list[dict[str, Any]]:
        found = [each["message"] for each in self.client.named("dap")]
        return [each["body"] for each in found if each.get("event") == name]


PROGRAM = app(COUNT, **{"actions__Act.py": COUNT})
AT_ONCE = 500
"""The requests of a flood between two looks at their replies."""
MODULES = {"adapter": "debug_adapter.process", "application": "application.process"}


async def begin(client: Any, *breakpoints: dict[str, Any], **more: Any) -> Debugger:
    debugger = Debugger(client)
    await debugger.ask("initialize")
    run = asyncio.create_task(client.ask("run", run_data(PROGRAM)))
    await debugger.configure(*breakpoints, **more)
    assert await run == "ack"
    return debugger


async def values(debugger: Debugger, stop: dict[str, Any]) -> dict[str, str]:
    found = await debugger.locals(await debugger.top(stop))
    return {name: each["value"] for name, each in found.items()}


def states(client: Any, after: int) -> list[str]:
    return [each["state"] for each in client.named("state-changed", after=after)]


async def test_a_line_holds_the_first_tick_shows_its_values_and_a_step_keeps_the_world_paused():
    async with session() as client:
        debugger = await begin(client, {"line": ADDS})
        stop = await debugger.event("stopped")
        await client.event("state-changed", lambda d: d["state"] == "held")
        assert client.named("held") == []
        [hold] = client.named("held_in_python")
        [block] = [node for node in client.named("tree")[-1]["nodes"] if node["uid"] == hold["uid"]]
        assert (block["type"], hold["path"][-1], hold["tick"]) == ("Act", hold["uid"], 1)
        frame = await debugger.top(stop)
        assert (frame["name"], frame["line"], frame["source"]["path"]) == ("update", ADDS, FILE)
        this = (await debugger.locals(frame))["self"]["variablesReference"]
        tree = await debugger.ask("variables", variablesReference=this)
        assert [each["value"] for each in tree["variables"] if each["name"] == "n"] == ["0"]
        at = len(client.events)
        await debugger.ask("next", threadId=stop["threadId"])
        stop = await debugger.event("stopped", at)
        frame = await debugger.top(stop)
        assert frame["line"] == ADDS + 1
        assert states(client, at) == [], "the world is paused in a step"
        found = await debugger.ask("completions", text="self.upd", column=9, frameId=frame["id"])
        assert "update" in [each["label"] for each in found["targets"]]
        assert client.named("flag") == [], "who only looks changes nothing"
        this = (await debugger.locals(frame))["self"]["variablesReference"]
        await debugger.ask("setVariable", name="n", value="41", variablesReference=this)
        flag = (await client.event("flag"))["data"]
        assert flag["text"] == "Changed by hand in Python: n = 41"
        await debugger.ask("evaluate", expression="self.n + 1", frameId=frame["id"], context="repl")
        at = len(client.events)
        await debugger.ask("continue", threadId=stop["threadId"])
        frame = await debugger.top(await debugger.event("stopped", at))
        assert states(client, at) == ["application_running", "held"]
        found = await debugger.ask("evaluate", expression="self.n", frameId=frame["id"], context="hover")
        assert found["result"] == "41"
        at = len(client.events)
        await debugger.ask("stepOut", threadId=stop["threadId"])
        frame = await debugger.top(await debugger.event("stopped", at))
        assert (frame["line"], frame["source"]["path"]) == (ADDS, FILE), "code outside is passed over"


async def test_a_condition_a_log_line_and_an_exception():
    async with session() as client:
        logs = {"line": ADDS + 1, "logMessage": "n is {self.n:03} of {most}"}
        at_five = {"line": ADDS, "condition": "self.n % 5 == 0", "hitCondition": ">=2"}
        debugger = await begin(client, at_five, logs)
        stop = await debugger.event("stopped")
        frame = await debugger.top(stop)
        found = await debugger.ask("evaluate", expression="self.n", frameId=frame["id"], context="hover")
        assert found["result"] == "5", "the passes where the condition is true count: 0 and 5"
        said = [each["text"] for each in client.named("log")]
        assert [text for text in said if text.startswith("n is")] == [
            f"n is 00{n} of {{most}}" for n in range(1, 6)
        ]
        nodes = {each["node_path"] for each in client.named("log") if each["text"].startswith("n is")}
        assert nodes == {client.named("tree")[-1]["nodes"][-1]["path"]}, "a line names its block"
        [wrong] = [text for text in said if "most" in text and not text.startswith("n is")]
        assert wrong.startswith(f"{FILE}:{ADDS + 1}: “most” of the log line cannot be evaluated: NameError")
        [told] = debugger.events("breakpoint")
        assert told["breakpoint"]["source"] == {"path": FILE}
        assert (told["breakpoint"]["line"], told["breakpoint"]["verified"]) == (ADDS + 1, False)
        await debugger.ask("setBreakpoints", source={"path": FILE}, breakpoints=[])
        await debugger.ask("setExceptionBreakpoints", filters=["raised"])
        await debugger.ask("evaluate", expression="setattr(self, 'n', 2000)", frameId=frame["id"])
        at = len(client.events)
        await debugger.ask("continue", threadId=stop["threadId"])
        stop = await debugger.event("stopped", at)
        assert stop["reason"] == "exception"
        assert (await debugger.ask("exceptionInfo", threadId=stop["threadId"]))["description"] == "too many"


async def test_a_condition_with_a_name_that_nobody_knows_never_stops_and_is_reported_once():
    async with session() as client:
        debugger = await begin(client, {"line": ADDS, "condition": "self.m == 5"}, {"line": ADDS + 2})
        await debugger.event("stopped")
        said = [each["text"] for each in client.named("log") if "condition" in each["text"]]
        assert len(said) == 1
        assert "AttributeError" in said[0]


async def test_the_answer_says_which_lines_have_no_code():
    """It names another line; the page takes such a breakpoint back."""
    source = action("""
def update(self):
    '''A docstring.'''
    # a comment
    return Status.RUNNING
""")
    first = source.split("\n").index("    def update(self):") + 1
    async with session() as client:
        debugger = Debugger(client)
        await debugger.ask("initialize")
        run = asyncio.create_task(client.ask("run", run_data(app(source, **{"actions__Act.py": source}))))
        await debugger.event("initialized")
        lines = [{"line": first + at} for at in range(4)]
        found = await debugger.ask("setBreakpoints", source={"path": FILE}, breakpoints=lines)
        assert [each["line"] - first for each in found["breakpoints"]] == [0, 0, 0, 3]
        await debugger.ask("setBreakpoints", source={"path": FILE}, breakpoints=[])
        await debugger.ask("configurationDone")
        assert await run == "ack"


async def test_a_program_that_runs_is_connected_and_continues_when_the_debugger_ends():
    async with session() as client:
        assert await client.ask("run", run_data(PROGRAM)) == "ack"
        debugger = Debugger(client)
        await debugger.ask("initialize")
        await debugger.configure({"line": ADDS})
        stop = await debugger.event("stopped")
        assert (await values(debugger, stop)).keys() >= {"self"}
        written = {"scope": "", "key": "n", "value": 5}
        for command, data in (("set_blackboard", written), ("step_over", {})):
            assert (await client.ask(command, data))["code"] == "held_in_python"
        assert await client.ask("pause") == "ack"
        at = len(client.events)
        await debugger.ask("disconnect")
        await client.event("tick", lambda d: d["n"] > 3, after=at)
        assert client.state == "application_running"
        assert client.named("fault") == []


@pytest.mark.kills
@pytest.mark.parametrize("who", ["adapter", "application"])
async def test_a_process_that_is_killed_while_held_leaves_the_ladder_true(who: str):
    async with own_session() as (manager, client):
        debugger = await begin(client, {"line": ADDS})
        await debugger.event("stopped")
        await client.event("state-changed", lambda d: d["state"] == "held")
        at = len(client.events)
        [process] = with_word(f"executor.{MODULES[who]}", psutil.Process(manager.pid).children())
        process.kill()
        state = "application_running" if who == "adapter" else "visualization_ready"
        await client.event("state-changed", lambda d: d["state"] == state, after=at)
        assert await debugger.event("terminated", at) == {}


async def test_the_program_is_ended_and_started_again_while_held():
    async with session() as client:
        debugger = await begin(client, {"line": ADDS})
        await debugger.event("stopped")
        at = len(client.events)
        again = asyncio.create_task(client.ask("restart_application"))
        await debugger.configure({"line": ADDS + 1}, after=at)
        assert await again == "ack"
        stop = await debugger.event("stopped", at)
        assert (await debugger.top(stop))["line"] == ADDS + 1
        assert await client.ask("terminate_application") == "ack"
        assert client.state == "visualization_ready"


async def test_a_foreign_program_without_the_token_is_refused():
    async with own_session() as (manager, client):
        debugger = await begin(client, {"line": ADDS})
        await debugger.event("stopped")
        [own] = with_word("executor.debug_adapter.process", psutil.Process(manager.pid).children())
        [listener] = [c for c in own.net_connections("tcp") if c.status == psutil.CONN_LISTEN]
        assert listener.laddr.ip == HOST
        assert not any(len(word) == 64 for word in own.cmdline())
        assert not any(len(value) == 64 for value in own.environ().values())
        reader, writer = await asyncio.open_connection(HOST, listener.laddr.port)
        asked = await reader.readuntil(b"}")
        assert b"pydevdAuthorize" in asked
        answer = {"seq": 1, "type": "response", "request_seq": 1, "command": "pydevdAuthorize"}
        body = {"success": True, "body": {"clientAccessToken": None}}
        writer.write(framed(json.dumps(answer | body).encode()))
        assert b"pydevdSystemInfo" not in await reader.read(), "it is closed without another word"
        writer.close()
        assert (await debugger.ask("threads"))["threads"], "the session's own program is still there"


async def test_a_program_that_runs_is_debugged_a_second_time():
    async with session() as client:
        debugger = await begin(client, {"line": ADDS})
        await debugger.event("stopped")
        at = len(client.events)
        await debugger.ask("disconnect")
        await client.event("tick", lambda d: d["n"] > 3, after=at)
        at = len(client.events)
        await debugger.ask("initialize")
        await debugger.configure({"line": ADDS + 1}, after=at)
        stop = await debugger.event("stopped", at)
        # debugpy may stop a second client at the first line of the function.
        assert (await debugger.top(stop))["name"] == "update"


async def test_a_client_that_sets_no_breakpoints_does_not_keep_the_program_from_its_start():
    async with session() as client:
        debugger = Debugger(client)
        await debugger.ask("initialize")
        assert await client.ask("run", run_data(PROGRAM)) == "ack"
        await debugger.event("initialized")
        await client.event("tick", lambda d: d["n"] > 3)
        assert any("was late" in each["text"] for each in client.named("log"))
        assert client.named("fault") == []


async def test_a_flood_of_requests_is_refused_and_the_program_stays_held():
    async with session() as client:
        debugger = await begin(client, {"line": ADDS})
        stop = await debugger.event("stopped")
        codes, began_s = Counter[str](), time.monotonic()
        answered = len(debugger.messages("threads"))
        for start in range(0, count("dap_flood"), AT_ONCE):
            for code in await flood(client, min(AT_ONCE, count("dap_flood") - start)):
                codes[code] += 1
        took_s = time.monotonic() - began_s
        asked = codes.pop("ack")
        assert asked <= (BURST + RATE_HZ * took_s) / COSTS["dap"] + 1
        assert codes.keys() == {"too_fast"}
        await client.until(lambda: len(debugger.messages("threads")) == answered + asked)
        await asyncio.sleep(1.0)  # the refusals ask for this wait: the allowance is filled again
        assert (await debugger.top(stop))["line"] == ADDS
        assert (client.state, client.named("fault")) == ("held", [])


async def flood(client: Any, number: int) -> list[str]:
    """Sends requests at once; returns "ack" or the code of the refusal of each."""
    at = len(client.events)
    message = {"seq": 1, "type": "request", "command": "threads"}
    sent = {await client.send("dap", {"message": message}) for _ in range(number)}

    def replies() -> list[dict[str, Any]]:
        return [event for event in client.events[at:] if event["id"] in sent]

    await client.until(lambda: len(replies()) == number)
    return [event["data"].get("code", "ack") for event in replies()]
