"""A running tree is replaced by a changed one, in a session with the real application."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from executor.application.changes.applying import NOT_APPLIED, Applying
from tests.executor.application.real_application import action, app, run_data, session
from tree_gardener import Tree
from tree_gardener.runner import Runner

COUNTS = action("""
def __init__(self, name, ports):
    super().__init__(name)
    self.ports, self.ticks = ports, 0
def initialise(self):
    print("initialise", self.ports["word"])
def update(self):
    self.ticks += 1
    print(self.ports["word"], self.ticks)
    return Status.RUNNING
def terminate(self, status):
    print("terminate", status.name)
""").replace("Behaviour):", 'Behaviour):\n    INPUT_PORTS = {"word": str}\n', 1)
OTHER = COUNTS.replace("self.ticks += 1", "self.ticks += 10")


def tree(word: str, before: str = "") -> str:
    return f"<Sequence _bts_id='s'>{before}<Act _bts_id='a' name='act' word='{word}'/></Sequence>"


async def test_a_running_action_continues_in_the_changed_tree():
    async with session() as client:
        assert await client.ask("run", run_data(app(COUNTS, tree("one")))) == "ack"
        await client.event("log", lambda d: d["text"].startswith("one 3"))
        at = len(client.events)
        changed = app(COUNTS, tree("two", "<AlwaysSuccess _bts_id='n'/>"))
        assert await client.ask("apply", {"app_zip_base64": changed}) == "ack"
        applied = (await client.event("applied", after=at))["data"]
        assert (applied["dry"], applied["kept"], applied["halted"], applied["removed"]) == (False, 2, [], [])
        assert [node["node_id"] for node in applied["added"]] == ["n"]
        described = (await client.event("tree", after=at))["data"]
        assert [node["node_id"] for node in described["nodes"]] == ["s", "n", "a"]
        line = (await client.event("log", lambda d: d["text"].startswith("two"), after=at))["data"]
        assert int(line["text"].split()[1]) > 3
        said = [each["data"]["text"] for each in client.events if each["command"] == "log"]
        assert [text for text in said if "terminate" in text or "initialise" in text] == ["initialise one"]
        # A restart runs the changed program.
        at = len(client.events)
        assert await client.ask("restart_application", {}) == "ack"
        await client.event("log", lambda d: d["text"] == "two 1", after=at)


async def test_a_dry_run_says_what_would_be_halted_and_changes_nothing():
    async with session() as client:
        assert await client.ask("run", run_data(app(COUNTS, tree("one")))) == "ack"
        await client.event("log", lambda d: d["text"].startswith("one 3"))
        at = len(client.events)
        changed = app(OTHER, tree("one"))
        assert await client.ask("apply", {"app_zip_base64": changed, "dry": True}) == "ack"
        applied = (await client.event("applied", after=at))["data"]
        assert [node["path"] for node in applied["renewed"]] == ["act"]
        assert [node["path"] for node in applied["halted"]] == ["act"]
        line = (await client.event("log", after=at))["data"]
        assert line["text"].startswith("one ")
        at = len(client.events)
        assert await client.ask("apply", {"app_zip_base64": changed}) == "ack"
        await client.event("log", lambda d: d["text"] == "terminate INVALID", after=at)
        await client.event("log", lambda d: d["text"] == "one 10", after=at)


@pytest.mark.parametrize(
    ("source", "body", "text"),
    [
        ("def", tree("one"), "actions/Act.py:1: Python cannot read it"),
        (COUNTS, "<Sequence _bts_id='s'/>", "Sequence has 0 children"),
        (
            COUNTS + "    def setup(self, **_):\n        raise ValueError('no camera')\n",
            tree("one"),
            "'act': ValueError: no camera",
        ),
    ],
)
async def test_a_tree_that_cannot_take_over_is_refused_with_its_place(source, body, text):
    async with session() as client:
        assert await client.ask("run", run_data(app(COUNTS, tree("one")))) == "ack"
        await client.event("log", lambda d: d["text"].startswith("one 2"))
        at = len(client.events)
        error = await client.ask("apply", {"app_zip_base64": app(source, body)})
        assert error["code"] == NOT_APPLIED
        assert text in error["message"]
        await client.event("log", lambda d: d["text"].startswith("one "), after=at)
        assert client.state == "application_running"


async def test_a_paused_tree_is_replaced_and_stays_paused():
    async with session() as client:
        assert await client.ask("run", run_data(app(COUNTS, tree("one")))) == "ack"
        await client.event("log", lambda d: d["text"].startswith("one 2"))
        assert await client.ask("pause", {}) == "ack"
        at = len(client.events)
        assert await client.ask("apply", {"app_zip_base64": app(COUNTS, tree("two"))}) == "ack"
        statuses = (await client.event("tick", after=at))["data"]
        assert statuses["changed"] == [[1, "RUNNING"], [2, "RUNNING"]]
        assert client.state == "paused"
        assert await client.ask("step", {}) == "ack"
        await client.event("log", lambda d: d["text"].startswith("two "), after=at)


async def test_many_refusals_leave_the_folder_of_the_running_project():
    async with session() as client:
        assert await client.ask("run", run_data(app(COUNTS, tree("one")))) == "ack"
        await client.event("log", lambda d: d["text"].startswith("one 2"))
        for _ in range(5):
            error = await client.ask("apply", {"app_zip_base64": app("def", tree("one"))})
            assert error["code"] == NOT_APPLIED
            assert "Python cannot read it" in error["message"]
        at = len(client.events)
        assert await client.ask("apply", {"app_zip_base64": app(COUNTS, tree("two"))}) == "ack"
        await client.event("log", lambda d: d["text"].startswith("two "), after=at)


def test_while_python_is_debugged_the_program_is_restarted_instead():
    text = "<root BTCPP_format='4'><BehaviorTree ID='Main'><AlwaysSuccess/></BehaviorTree></root>"
    none: Any = None
    applying = Applying(none, Runner(Tree.from_xml(text), tick_hz=10), none, none)
    applying.has_python_debugger = True
    error = applying.run(Path("other"), none, dry=True)
    assert error is not None
    assert (error.code, error.hint) == (NOT_APPLIED, "Restart the program to use the new code.")
