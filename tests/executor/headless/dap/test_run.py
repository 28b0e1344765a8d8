"""`bt-studio dap` with a client of the protocol: lines of JSON and XML, steps, values, and their end."""

from __future__ import annotations

import queue
import shutil
from typing import TYPE_CHECKING, Any

import pytest

from executor.headless.dap.run import launched
from executor.headless.dap.wire import Request
from tests.executor.headless.dap.client import ROOT, DapClient

if TYPE_CHECKING:
    from pathlib import Path

EXAMPLE = ROOT / "examples" / "laser_bump_and_go"
TREE = EXAMPLE / "trees" / "MainTree.json"
XML = """<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence name="top">
      <Script code="speed := 1; name := 'a'"/>
      <SubTree ID="Sub"
               x="{speed}"/>

      <AlwaysFailure/>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Sub">
    <Sequence>
      <AlwaysSuccess name="mine" _skipIf="x == 9"/>
    </Sequence>
  </BehaviorTree>
</root>
"""

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(240)]


def line_of(path: Path, text: str) -> int:
    return next(n for n, line in enumerate(path.read_text().splitlines(), 1) if text in line)


def at(client: DapClient) -> tuple[str, int]:
    """Returns the text of the next stop, and the line of the innermost frame."""
    stop = client.event("stopped")
    frame = client.ask("stackTrace", threadId=1)["stackFrames"][0]
    return str(stop["text"]), int(frame["line"])


def variables(client: DapClient, scope: str) -> dict[str, Any]:
    frame = client.ask("stackTrace", threadId=1)["stackFrames"][0]["id"]
    found = {each["name"]: each for each in client.ask("scopes", frameId=frame)["scopes"]}
    rows = client.ask("variables", variablesReference=found[scope]["variablesReference"])["variables"]
    return {each["name"]: each["value"] for each in rows} | {"": found[scope]["variablesReference"]}


def test_why_turn_never_ends_is_found_at_a_line_of_the_diagram() -> None:
    with DapClient() as client:
        assert client.refused("threads") == "launch a project first"
        client.launch(project=str(EXAMPLE), duration=30)
        check = line_of(TREE, "CheckObstacle")
        [good, condition, past] = client.ask(
            "setBreakpoints",
            source={"path": str(TREE)},
            breakpoints=[{"line": check}, {"line": check, "condition": "a := 1"}, {"line": 9999}],
        )["breakpoints"]
        assert (good["verified"], good["line"]) == (True, check)
        assert "may only read" in condition["message"]
        assert past["verified"] is False
        client.ask("configurationDone")
        text, line = at(client)
        assert "before its tick (breakpoint 1" in text
        assert line == check
        stack = client.ask("stackTrace", threadId=1)["stackFrames"]
        assert [frame["id"] for frame in stack] == [4, 3, 2, 1]
        assert stack[0]["source"]["path"] == str(TREE)
        assert variables(client, "Ports")["obs_dist"] == "'1.0'"
        client.ask("next", threadId=1)
        assert "it returned" in at(client)[0]
        assert "force" in client.ask("evaluate", expression="help", context="repl")["result"]
        client.ask("evaluate", expression="force Turn::5 failure", context="repl")
        client.ask("setBreakpoints", source={"path": str(TREE)}, breakpoints=[])
        client.ask("continue", threadId=1)
        client.ask("pause", threadId=1)
        assert "a hold was requested" in client.event("stopped")["text"]
        client.ask("disconnect")
        client.event("terminated")
        assert client.process.wait(60) == 0


def test_lines_of_xml_with_its_blackboard(tmp_path: Path) -> None:
    file = tmp_path / "tree.xml"
    file.write_text(XML)
    with DapClient() as client:
        client.launch(project=str(file), universe="empty", duration=1, stopOnEntry=True)
        rows = [{"line": 6}, {"line": 13, "hitCondition": ">= 1"}, {"line": 4, "logMessage": "it is {speed}"}]
        answers = client.ask("setBreakpoints", source={"path": str(file)}, breakpoints=rows)["breakpoints"]
        assert [(each["verified"], each["line"]) for each in answers] == [(True, 5), (True, 13), (True, 4)]
        client.ask("configurationDone")
        assert at(client)[1] == 3
        client.ask("stepIn", threadId=1)
        assert at(client)[1] == 4
        client.ask("continue", threadId=1)
        assert at(client)[1] == 5
        assert "Script::2: it is {speed}" in client.printed
        client.ask("continue", threadId=1)
        text, line = at(client)
        assert (line, "mine" in text) == (13, True)
        frames = client.ask("stackTrace", threadId=1)["stackFrames"]
        assert [frame["line"] for frame in frames] == [13, 12, 5, 3]
        board = variables(client, "Blackboard")
        assert (board["speed"], board["name"]) == ("1", "'a'")
        changed = client.ask("setVariable", variablesReference=board[""], name="speed", value="4 + 5")
        assert changed["value"] == "9"
        why = client.refused("setVariable", variablesReference=board[""], name="speed", value="'fast'")
        assert "is not a number" in why
        assert (
            client.ask("evaluate", expression="x", frameId=frames[0]["id"], context="hover")["result"] == "9"
        )
        why = client.refused("evaluate", expression="x := 3", frameId=frames[0]["id"], context="watch")
        assert "only read" in why
        client.ask("stepOut", threadId=1)
        client.event("stopped")
        client.ask("setBreakpoints", source={"path": str(file)}, breakpoints=[])
        client.ask("continue", threadId=1)
        assert client.event("exited")["exitCode"] == 0
        assert "after 1 ticks" in client.printed
        assert client.process.wait(60) == 0


def test_an_editor_on_another_machine_starts_the_adapter_by_ssh(tmp_path: Path) -> None:
    near, far = tmp_path / "near" / "bump", tmp_path / "far" / "work" / "bump"
    for copy in (near, far):
        shutil.copytree(EXAMPLE, copy)
    ssh = tmp_path / "ssh"  # as ssh does: the words behind the host go to a shell, which starts elsewhere
    ssh.write_text(f'#!/bin/sh\nshift\ncd {tmp_path}/far\nexport PYTHONPATH={ROOT}\nexec sh -c "$*"\n')
    ssh.chmod(0o755)
    tree = near / "trees" / "MainTree.json"
    line = line_of(tree, "CheckObstacle")
    with DapClient(str(ssh), "robot") as client:
        client.ask("initialize", adapterID="bt-studio")
        assert "absolute path" in client.refused("launch", project="work/bump", localRoot="near/bump")
        client.ask("launch", project="work/bump", localRoot=str(near), duration=5)
        client.event("initialized")
        [there, unknown] = [
            client.ask("setBreakpoints", source={"path": str(path)}, breakpoints=[{"line": line}])[
                "breakpoints"
            ][0]
            for path in (tree, far / "trees" / "MainTree.json")
        ]
        assert there["verified"]
        assert unknown["message"] == "the file is no tree of this project"
        client.ask("configurationDone")
        assert at(client)[1] == line
        assert client.ask("stackTrace", threadId=1)["stackFrames"][0]["source"]["path"] == str(tree)
        client.stdin.close()  # the connection is cut
        assert client.process.wait(60) == 0


class Client:
    """A client whose requests stand ready."""

    def __init__(self, *requests: Request) -> None:
        self.requests: queue.Queue[Request] = queue.Queue()
        self.said: list[tuple[str, Any]] = []
        for request in requests:
            self.requests.put(request)

    def respond(self, request: Request, body: Any = None) -> None:
        self.said.append((request.command, body))

    def refuse(self, request: Request, why: str) -> None:
        self.said.append((request.command, why))


def test_a_launch_has_its_options(tmp_path: Path) -> None:
    wire: Any = Client(
        Request(1, "initialize", {"linesStartAt1": False}),
        Request(2, "launch", {"project": str(tmp_path), "duration": "long"}),
        Request(3, "launch", {"project": str(tmp_path), "seed": 4, "robot": "r", "stopOnEntry": True}),
    )
    found = launched(wire)
    assert found is not None
    assert (found.first_line, found.project, found.stops) == (0, tmp_path, True)
    assert (found.options.seed, found.options.robot, found.options.universe) == (4, "r", None)
    assert wire.said[0][1]["supportsSetVariable"]
    assert wire.said[1] == ("launch", '"duration" is a number of simulated seconds')
    gone: Any = Client(Request(0, "disconnect"))
    assert launched(gone) is None
