"""Processes that an action starts end with the run, and do not delay its end, in each way to run."""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, Final

import psutil
import pytest

from tests.action_errors.rows import EVALUATION
from tests.executor.evaluation.one_by_one import Cells
from tests.executor.session_client import run_data
from tests.executor.warm import warm_session
from translator import open_path, to_app_zip

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(300)]

LONG: Final = "86397"
"""The seconds that the processes would sleep; no other process of the machine has this number."""
STARTING: Final = f"""import multiprocessing
import subprocess
import time

import py_trees


class Starting(py_trees.behaviour.Behaviour):
    def update(self):
        multiprocessing.Process(target=time.sleep, args=({LONG},)).start()
        subprocess.Popen(["sleep", "{LONG}"])
        subprocess.run("sleep {LONG} >/dev/null &", shell=True)
        return py_trees.common.Status.SUCCESS
"""
TREE: Final = {
    "format": "bt-studio/diagram",
    "version": 1,
    "id": "Main",
    "root": "n",
    "nodes": {"n": {"type": "Starting"}},
}


def project(folder: Path) -> Path:
    """Writes a project whose action starts processes."""
    settings = {"name": "starting", "main_tree": "Main", "universe": "walled_room"}
    files = {
        "project.json": json.dumps(settings),
        "trees/Main.json": json.dumps(TREE),
        "actions/Starting.py": STARTING,
        "evaluations/main.yaml": EVALUATION.replace("tree: SUCCESS", "never: collision"),
    }
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def left(pid: int) -> list[psutil.Process]:
    """Returns the living descendants of a process."""
    found = psutil.Process(pid).children(recursive=True)
    return [each for each in found if each.status() != psutil.STATUS_ZOMBIE]


@pytest.fixture
def cells() -> Iterator[Cells]:
    with Cells() as made:
        yield made


@pytest.mark.parametrize("sealed", [False, True])
def test_of_an_evaluation(tmp_path: Path, cells: Cells, sealed: bool) -> None:
    assert cells(project(tmp_path), sealed=sealed).outcome == "success"
    assert left(cells.pid) == []


@pytest.mark.parametrize("time", ["live", "exact"])
async def test_of_a_session(tmp_path: Path, time: str) -> None:
    app = base64.b64encode(to_app_zip(open_path(project(tmp_path)))).decode()
    data = run_data(app, on_finish="stop")
    if time == "exact":
        data["universe"]["time"] = time
    async with warm_session() as (manager, client):
        assert await client.ask("run", data) == "ack"
        assert (await client.event("finished"))["data"]["status"] == "SUCCESS"
        await client.comes_to("visualization_ready")
        await client.until(lambda: not [each for each in left(manager.pid) if each.name() == "sleep"])
