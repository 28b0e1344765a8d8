"""`bt-studio attach` follows a real program of BehaviorTree.CPP in the terminal."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from backend.cli.debugging.attach import Following, attach, in_words
from backend.cli.shared.errors import CliError
from executor.recorder.summary.facts import facts_of
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import XML, cpp_program
from tree_gardener import Tree
from tree_gardener.groot import Groot2Publisher
from tree_gardener.groot.client import Groot2Client

if TYPE_CHECKING:
    from pathlib import Path


def test_a_program_is_followed_and_recorded_until_the_user_ends_it(tmp_path: Path) -> None:
    port, record = free_port(), tmp_path / "seen.mcap"
    command = [sys.executable, "-m", "backend.cli.main", "attach", f"127.0.0.1:{port}", "--json"]
    command += ["--record", str(record)]
    events = []
    with (
        cpp_program(port),
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process,
    ):
        assert process.stdout is not None
        assert process.stderr is not None
        for text in process.stdout:
            events.append(json.loads(text))
            if sum(each["event"] == "status" and each["path"] == "Sleep" for each in events) == 2:
                break  # a whole tick has been seen
        process.send_signal(signal.SIGINT)
        process.stdout.read()
        assert process.stderr.read() == "detached\n"
        assert process.wait() == 0
    known = [each for each in events if each["event"] != "silence"]
    assert known[0]["event"] == "tree"
    assert [row["path"] for row in known[0]["nodes"][:4]] == ["top", "Script", "mine", "mine/Inverter"]
    (written,) = (each for each in known if each.get("key") == "b")
    assert (written["scope"], written["value"]) == ("Main", "x")
    with record.open("rb") as recorded:
        facts = facts_of(recorded, record.name)
    assert facts.ticks > 0
    assert b"<Sleep" in facts.xml, "bt-studio open makes a project of it"


def test_changes_are_said_once_and_a_new_program_from_its_beginning() -> None:
    port = free_port()
    tree = Tree.from_xml(XML)
    with Groot2Client("127.0.0.1", port, 60.0) as client:
        following = Following(client)
        with Groot2Publisher(tree, port):
            (first,) = following.look()
            begin = ["#1 top [Sequence] IDLE", "  #2 Script IDLE", "  #3 mine [SubTree] IDLE"]
            assert in_words(first).splitlines()[:3] == begin
            tree.tick_exactly_once()
            tree.tick_exactly_once()
            said = [in_words(line) for line in following.look()]
            assert "#9 Sleep RUNNING" in said
            assert "#4 mine/Inverter IDLE (was SUCCESS)" in said
            assert "Main.a = 3" in said
            assert list(following.look()) == []
            tree.blackboard.set("b", "\x1b[2J")
            tree.blackboard.unset("a")
            tree.tick_exactly_once()
            said = [in_words(line) for line in following.look()]
            assert "Main.a was removed" in said
            assert 'Main.b = "\\u001b[2J"' in said
        with Groot2Publisher(tree, port):
            assert next(iter(following.look()))["event"] == "tree"


def test_signs_that_control_a_terminal_are_not_printed() -> None:
    line = {"event": "status", "uid": 1, "path": "a\x1b[2Jb", "status": "IDLE"}
    assert in_words(line) == "#1 a\ufffd[2Jb IDLE"


@pytest.mark.parametrize(("address", "status"), [("ipc:///tmp/x", 2), ("127.0.0.1:{port}", 1)])
def test_an_address_that_cannot_be_reached_says_why(address: str, status: int) -> None:
    with pytest.raises(CliError) as raised:
        attach(address.format(port=free_port()), once=True, hz=20.0, as_json=False, record=None)
    assert raised.value.status == status
