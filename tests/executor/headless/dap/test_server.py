"""Requests about a tree that runs or is held, each as the protocol describes it."""

from __future__ import annotations

import queue
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from executor.headless.dap.lines import Lines
from executor.headless.dap.paths import Folder
from executor.headless.dap.server import Server
from executor.headless.dap.wire import Request
from tests.deadline import DEADLINE_S
from tests.executor.headless.dap.test_lines import XML
from tree_gardener import Tree
from tree_gardener.debugging import Debugger, DebuggingEnded

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tree_gardener.debugging import Stop

FOLDER = Folder(Path("/project"))


class Client:
    """The client, and the wire to it."""

    def __init__(self) -> None:
        self.requests: queue.Queue[Request] = queue.Queue()
        self.said: queue.Queue[tuple[Any, Any]] = queue.Queue()

    def respond(self, request: Request, body: dict[str, Any] | None = None) -> None:
        self.said.put((request.command, body or {}))

    def refuse(self, request: Request, why: str) -> None:
        self.said.put((request.command, why))

    def tell(self, event: str, **body: Any) -> None:
        self.said.put((event, body))

    def ask(self, command: str, **arguments: Any) -> Any:
        self.requests.put(Request(1, command, arguments))
        name, body = self.said.get(timeout=DEADLINE_S)
        assert name == command
        return body

    def stopped(self) -> Any:
        name, body = self.said.get(timeout=DEADLINE_S)
        assert name == "stopped"
        return body


class Debugged:
    """A tree that ticks on a thread of its own until the client ends it."""

    def __init__(self) -> None:
        self.client = Client()
        self.tree = Tree.from_xml(XML)
        self.debugger = Debugger(self._hold)
        self.tree.debug(self.debugger)
        wire: Any = self.client
        lines = Lines({"t.xml": XML.encode()}, self.tree.nodes)
        self.server = Server(wire, self.tree, self.debugger, lines, FOLDER, lambda: 1.5)
        self.thread = threading.Thread(target=self._run)
        self.thread.start()

    def _hold(self, stop: Stop) -> None:
        self.server.hold(stop)

    def _run(self) -> None:
        try:
            self.server.configure()
            while True:
                self.server.poll()
                self.tree.tick_exactly_once()
        except DebuggingEnded:
            pass


@pytest.fixture
def client() -> Iterator[Client]:
    debugged = Debugged()
    yield debugged.client
    debugged.client.requests.put(Request(9, "disconnect"))
    debugged.thread.join(DEADLINE_S)
    assert not debugged.thread.is_alive()


def set_at(client: Client, *rows: dict[str, Any], path: str = "/project/t.xml") -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = client.ask("setBreakpoints", source={"path": path}, breakpoints=list(rows))[
        "breakpoints"
    ]
    return found


def test_the_tree_waits_for_its_breakpoints_and_stops_at_a_line_of_all_instances(client: Client) -> None:
    assert set_at(client, {"line": 11})[0]["verified"]
    assert client.ask("setExceptionBreakpoints", filters=[]) == {"breakpoints": []}
    client.ask("configurationDone")
    texts = []
    for _ in range(2):
        stop = client.stopped()
        assert (stop["reason"], stop["threadId"], stop["allThreadsStopped"]) == ("breakpoint", 1, True)
        texts.append(stop["text"])
        client.ask("continue", threadId=1)
    assert texts[0].startswith(
        "x > y/AlwaysSuccess::3 before its tick (breakpoint 1 before its tick), 1.50 s, tick 1"
    )
    assert texts[1].startswith("Sub::")


def test_the_stack_is_the_path_and_can_be_read_in_parts(client: Client) -> None:
    set_at(client, {"line": 11})
    client.ask("configurationDone")
    client.stopped()
    stack = client.ask("stackTrace", threadId=1)
    assert stack["totalFrames"] == 3
    assert [frame["line"] for frame in stack["stackFrames"]] == [11, 4, 3]
    assert stack["stackFrames"][0]["source"] == {"name": "t.xml", "path": "/project/t.xml"}
    part = client.ask("stackTrace", threadId=1, startFrame=1, levels=1)["stackFrames"]
    assert [frame["line"] for frame in part] == [4]
    scopes = client.ask("scopes", frameId=part[0]["id"])["scopes"]
    assert [scope["name"] for scope in scopes] == ["Ports", "Blackboard"]
    assert client.ask("scopes", frameId=77) == "there is no frame 77"
    assert "has continued" in client.ask("variables", variablesReference=99)
    assert "has continued" in client.ask("setVariable", variablesReference=99, name="a", value="1")


def test_steps_and_pause_have_their_reasons(client: Client) -> None:
    client.ask("configurationDone")
    client.ask("pause", threadId=1)
    assert client.stopped()["reason"] == "pause"
    client.ask("pause", threadId=1)  # it is held already
    for step in ("stepIn", "next", "stepOut"):
        assert client.ask(step, threadId=1) == {}
        assert client.stopped()["reason"] == "step"
    client.ask("continue", threadId=1)


def test_nothing_is_looked_at_while_the_tree_runs(client: Client) -> None:
    client.ask("configurationDone")
    for command in ("stackTrace", "scopes", "evaluate", "continue", "next"):
        assert "the tree runs" in client.ask(command, threadId=1, expression="1")
    assert client.ask("threads") == {"threads": [{"id": 1, "name": "tree Main"}]}
    known = client.ask("runInTerminal")
    assert known.startswith("'runInTerminal' is not known here; known are ")


def test_a_wrong_breakpoint_says_why_and_the_others_hold(client: Client) -> None:
    rows: list[dict[str, Any]] = [
        {"line": 7},
        {"line": "x"},
        {"line": 7, "condition": "a := 1"},
        {"line": 7, "condition": "("},
        {"line": 7, "hitCondition": "often"},
        {"line": 99},
    ]
    answers = set_at(client, *rows)
    assert [each["verified"] for each in answers] == [True, False, False, False, False, False]
    assert all(each["message"] for each in answers[1:])
    [other] = set_at(client, {"line": 7}, path="/elsewhere/t.xml")
    assert other["message"].startswith("the file is no tree of this project; if the editor runs on another")
    [python] = set_at(client, {"line": 7}, path="/project/actions/Go.py")
    assert "in Python are set in the page" in python["message"]
    assert "need the path" in client.ask("setBreakpoints", source=3, breakpoints=[])
    assert "1000 at most" in client.ask(
        "setBreakpoints", source={"path": "t.xml"}, breakpoints=[{"line": 7}] * 1001
    )
    client.ask("configurationDone")
    assert "AlwaysSuccess" in client.stopped()["text"]


def test_the_console_takes_scripts_and_commands_of_the_prompt(client: Client) -> None:
    set_at(client, {"line": 7})
    client.ask("configurationDone")
    client.stopped()
    assert client.ask("evaluate", expression="a := 4", context="repl")["result"] == "4"
    assert client.ask("evaluate", expression="a", context="watch")["result"] == "4"
    assert "only read" in client.ask("evaluate", expression="a := 5", context="watch")
    assert "AlwaysSuccess" in client.ask("evaluate", expression="where", context="repl")["result"]
    forced = client.ask("evaluate", expression="force #4 failure", context="repl")["result"]
    assert "is FAILURE" in forced
    assert (
        "no node has" in client.ask("evaluate", expression="force Nobody failure", context="repl")["result"]
    )
    client.ask("next", threadId=1)
    assert "it returned FAILURE" in client.stopped()["text"]
