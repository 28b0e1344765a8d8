"""Help with Python from a user's container: the real tools behind the real keeper, without Docker."""

from __future__ import annotations

import json
import tempfile
import time
from pathlib import Path

import pytest

from backend.language import consumers, tools
from backend.language.protocol.messages import SOURCE_METHOD
from backend.sessions.lifecycle import writes
from tests.backend.language.conftest import GO, SOURCE, opened
from tests.backend.sessions.keeper.conftest import Host

pytestmark = pytest.mark.django_db(transaction=True)


@pytest.fixture
def keeper():
    """The real keeper, with an engine whose containers are children of this process."""
    with tempfile.TemporaryDirectory() as folder:
        made = Host(Path(folder), "tools", 1, patience_s=60)
        yield made
        made.close()


@pytest.fixture
def contained(host, keeper, limits, monkeypatch):
    """The server's address; its sessions and tools come from the keeper."""
    limits(launcher="docker", keeper_folder=keeper.folder)
    monkeypatch.setattr(writes, "launcher", lambda: keeper.launcher)
    monkeypatch.setattr(tools, "launcher", lambda: keeper.launcher)
    monkeypatch.setattr(tools, "addresses", {})
    return host


def test_an_editor_knows_neighbours_follows_revisions_and_leaves_nothing(
    contained,
    keeper,
    with_actions,
    api,
):
    with opened(contained, f"/ws/projects/{with_actions}/language") as page:
        page.begin()
        page.open(GO, SOURCE.replace("import Turn\n", "import Turn\nfrom Spin import Spin\n"))
        assert page.at("definition", 3, 18)[0]["uri"] == "file:///project/actions/Turn.py"
        assert not page.at("definition", 4, 18), "there is no such file"
        [status] = page.at("definition", 11, 41)
        assert "class Status" in page.ask(SOURCE_METHOD, uri=status["uri"])["text"]
        nowhere = "file:///library/packages/none.py"
        assert page.ask(SOURCE_METHOD, uri=nowhere)["message"] == "This file cannot be shown."
        spin = {"path": "actions/Spin.py", "base_revision": 0, "content": "class Spin:\n    pass\n"}
        api.save(with_actions, spin)
        deadline = time.monotonic() + 60
        while [each["uri"] for each in page.at("definition", 4, 18) or ()] != [
            "file:///project/actions/Spin.py"
        ]:
            assert time.monotonic() < deadline
            time.sleep(0.05)
        assert "/tmp" not in json.dumps(page.told)  # noqa: S108
        [name] = keeper.docker.containers
        assert name.startswith("stack-tools-")

    # The same container formats; a container that has ended is replaced without the user noticing.
    answer = {"source": 'x = {"a": 1}\n', "findings": []}
    asked = {"source": "x = {  'a':1 }\n", "filename": "actions/Go.py"}
    assert api.post("python/format", asked) == answer
    keeper.docker.children[name].kill()
    keeper.docker.children[name].wait()
    assert api.post("python/format", asked) == answer
    [finding] = api.post("python/lint", {"source": "import os\n"})["findings"]
    assert finding["code"] == "F401"


def test_without_a_place_or_a_keeper_it_is_said(contained, keeper, with_actions, api):
    keeper.tools.max_tools = 0
    with opened(contained, f"/ws/projects/{with_actions}/language") as page:
        assert page.ended() == consumers.UNAVAILABLE
    problem = api.post("python/lint", {"source": "x"}, expect=503)
    assert problem["code"] == "python_help_unavailable"
    assert "Too many people" in problem["detail"]
    keeper.server.shutdown()
    keeper.server.server_close()
    problem = api.post("python/lint", {"source": "x"}, expect=503)
    assert "does not answer" in problem["detail"]
