"""`bt-studio dap` says in a sentence why it cannot debug, and ends with its client."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

import pytest

from backend.cli.debugging.dap import dap
from backend.cli.main import VERBS
from tests.executor.headless.dap.client import ROOT, DapClient

if TYPE_CHECKING:
    from pathlib import Path

EXAMPLE = ROOT / "examples" / "laser_bump_and_go"

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(240)]


def test_what_cannot_be_launched_is_refused_in_a_sentence(tmp_path: Path) -> None:
    assert VERBS["dap"].function == dap.__name__
    with DapClient() as client:
        client.write([1])
        client.write({"type": "request", "seq": "x", "command": 3})
        client.ask("initialize", adapterID="bt-studio")
        assert "no such file" in client.refused("launch", project=str(tmp_path / "no"))
        assert "needs" in client.refused("launch")
        assert "keep moving" in client.refused("launch", project=str(EXAMPLE), universe="none")
        broken = tmp_path / "broken.xml"
        broken.write_text("<root>")
        assert "broken.xml" in client.refused("launch", project=str(broken))
        client.event("terminated")


def test_an_action_that_fails_is_reported_and_the_end_of_the_input_ends_the_run(tmp_path: Path) -> None:
    project = tmp_path / "p"
    shutil.copytree(EXAMPLE, project)
    action = project / "actions" / "CheckObstacle.py"
    action.write_text(action.read_text().replace("def update(self):", "def update(self):\n        1 / 0"))
    with DapClient() as client:
        client.launch(project=str(project), duration=1)
        client.ask("configurationDone")
        assert client.event("exited")["exitCode"] == 1
        assert "division by zero" in client.printed
        client.event("terminated")
    with DapClient() as client:
        client.launch(project=str(EXAMPLE))
        client.stdin.close()
        assert client.process.wait(60) == 0
