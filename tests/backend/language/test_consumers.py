"""A page and its language server, over real sockets, with the real server."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

import psutil
import pytest
from websockets.exceptions import InvalidStatus

from backend.language import consumers, places, servers
from backend.language.protocol.messages import SOURCE_METHOD
from backend.projects.documents import checking
from tests.backend.language.conftest import GO, SOURCE, opened
from tests.processes import with_word

pytestmark = pytest.mark.django_db(transaction=True)
FAKE = Path(__file__).parents[2] / "fakes" / "language_server.py"


def test_it_knows_messages_engine_and_neighbours_and_unsaved_text(host, with_actions, api):
    with opened(host, f"/ws/projects/{with_actions}/language") as page:
        page.begin()
        unsaved = SOURCE.replace("twist.linear.x = 1.0", "twist.linear.")
        page.open(GO, unsaved)

        items = page.at("completion", 9, 21)
        labels = [each["label"] for each in items["items"]]
        assert labels[:3] == ["x", "y", "z"]
        assert "Cannot find" not in json.dumps(page.told)

        [place] = page.at("definition", 3, 18)
        assert place["uri"] == "file:///project/actions/Turn.py"
        assert page.at("hover", 1, 32)["contents"]["value"].rstrip().endswith("`geometry_msgs/msg/Twist`")
        found = page.at("references", 3, 18, context={"includeDeclaration": True})
        assert {each["uri"] for each in found} == {GO, "file:///project/actions/Turn.py"}

        edits = page.ask(
            "textDocument/rename",
            textDocument={"uri": GO},
            position={"line": 3, "character": 18},
            newName="Spin",
        )
        assert set(json.loads(json.dumps(edits))["changes"]) == {GO, "file:///project/actions/Turn.py"}


def test_it_follows_the_revisions_of_the_project(host, with_actions, api):
    with opened(host, f"/ws/projects/{with_actions}/language") as page:
        page.begin()
        page.open(GO, SOURCE.replace("from Turn import Turn", "from Spin import Spin"))
        assert not page.at("definition", 3, 18), "there is no such file"
        api.save(
            with_actions,
            {"path": "actions/Spin.py", "base_revision": 0, "content": "class Spin:\n    pass\n"},
        )
        deadline = time.monotonic() + 60
        while [each["uri"] for each in page.at("definition", 3, 18) or ()] != [
            "file:///project/actions/Spin.py"
        ]:
            assert time.monotonic() < deadline
            time.sleep(0.05)


@pytest.mark.parametrize(
    ("source", "place", "text"),
    [
        ("import rclpy.node\n", (0, 14), "class Node"),
        ("import py_trees.common\n", (0, 17), "class Status"),
        ("import json\n", (0, 8), "def dumps"),
        ("x = len(())\n", (0, 5), "def len"),
        ("import tree_gardener.ports\n", (0, 21), "class Port"),
        ("from sensor_msgs.msg import LaserScan\n", (0, 30), "LaserScan"),
    ],
)
def test_a_definition_outside_of_the_project_can_be_read_and_asked_about(
    host, with_actions, source, place, text
):
    with opened(host, f"/ws/projects/{with_actions}/language") as page:
        page.begin()
        page.open(GO, source)
        uri = page.at("definition", *place)[0]["uri"]
        assert uri.startswith("file:///library/")
        shown = page.ask(SOURCE_METHOD, uri=uri)["text"]
        assert text in shown
        page.open(uri, shown)
        line = next(number for number, each in enumerate(shown.split("\n")) if text in each)
        start = shown.split("\n")[line].index(text) + len(text) - 1
        position = {"line": line, "character": start}
        assert page.ask("textDocument/hover", textDocument={"uri": uri}, position=position)


def test_only_sources_are_given_out(host, with_actions, tmp_path):
    (tmp_path / "secret.py").write_text("secret = 1\n")
    with opened(host, f"/ws/projects/{with_actions}/language") as page:
        page.begin()
        foreign = ("file:///etc/passwd", f"file://{tmp_path}/secret.py", "file:///library/python/../../x.py")
        for uri in foreign:
            assert "not a file of this project" in page.ask(SOURCE_METHOD, uri=uri)["message"]
        for uri in ("file:///library/python/LICENSE.txt", "file:///library/packages/none.py", GO):
            assert page.ask(SOURCE_METHOD, uri=uri)["message"] == "This file cannot be shown."
        assert "cannot be shown" in page.ask(SOURCE_METHOD)["message"]


def test_it_names_no_file_of_the_machine(host, with_actions):
    with opened(host, f"/ws/projects/{with_actions}/language") as page:
        page.begin()
        refused = page.ask("textDocument/hover", textDocument={"uri": "file:///etc/passwd"})
        assert "not a file of this project" in refused["message"]
        page.socket.send("{")
        assert page.ended() == 1003


def test_more_python_than_is_checked_gets_no_help(host, with_actions, monkeypatch):
    monkeypatch.setattr(checking, "MOST_CHECKED", 10)
    with opened(host, f"/ws/projects/{with_actions}/language") as page:
        assert page.ended() == consumers.UNAVAILABLE


def test_nobody_else_gets_one(host, with_actions):
    path = f"/ws/projects/{with_actions}/language"
    with pytest.raises(InvalidStatus), opened(host, path, origin="http://evil.example"):
        pass
    with pytest.raises(InvalidStatus), opened(host, path, additional_headers={}):
        pass
    missing = "/ws/projects/00000000-0000-0000-0000-000000000000/language"
    with opened(host, missing) as page:
        assert page.ended() == consumers.NO_SUCH_PROJECT


@pytest.fixture
def fake_server(monkeypatch):
    """Makes the next servers fakes of a kind."""

    def use(kind):
        fake = servers.ProcessLauncher((sys.executable, str(FAKE), kind))
        monkeypatch.setattr(consumers, "launcher", lambda: fake)

    return use


ENDS: Any = {
    "dies": ({}, consumers.ENDED),
    "garbage": ({}, consumers.ENDED),
    "hungry": ({"language_memory_mib": 50}, consumers.TOO_MUCH_MEMORY),
    "echo": ({"language_idle_s": 0.1}, consumers.IDLE),
}


@pytest.mark.parametrize("kind", ENDS)
def test_it_ends_with_a_reason_and_leaves_no_process(host, project, fake_server, limits, kind):
    options, code = ENDS[kind]
    limits(**options)
    fake_server(kind)
    with opened(host, f"/ws/projects/{project['id']}/language") as page:
        page.notify("initialized")
        assert page.ended() == code
    assert with_word(str(FAKE), psutil.Process().children(recursive=True)) == []


def test_there_are_only_so_many(host, project, limits):
    limits(max_language_servers=0)
    with opened(host, f"/ws/projects/{project['id']}/language") as page:
        assert page.ended() == consumers.TOO_MANY


def test_a_team_server_without_containers_says_that_there_is_none(host, with_actions, monkeypatch):
    without = type("Team", (), {"is_team": True, "has_containers": False})
    monkeypatch.setattr(places, "environment", lambda: without)
    with opened(host, f"/ws/projects/{with_actions}/language") as page:
        assert page.ended() == consumers.UNAVAILABLE


def test_an_open_project_hears_of_its_revisions(host, with_actions, api):
    with opened(host, f"/ws/projects/{with_actions}/notices") as page:
        first = json.loads(page.socket.recv(timeout=60))
        assert first == {"type": "revision", "revision": 2, "author": "", "message": ""}
        api.save(with_actions, {"path": "a.txt", "base_revision": 0, "content": "a"}, message="Say something")
        told = json.loads(page.socket.recv(timeout=60))
        assert (told["revision"], told["message"]) == (3, "Say something")
    with opened(host, "/ws/projects/00000000-0000-0000-0000-000000000000/notices") as page:
        assert page.ended() == 4404
