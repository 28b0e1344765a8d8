"""Whatever an action puts on the blackboard, the run continues, in every way to run."""

from __future__ import annotations

import contextlib
import json
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgpack
import pytest

from tests.executor.application.real_application import app, run_data, session
from tests.executor.evaluation import projects
from tests.executor.evaluation.one_by_one import Cells
from tests.executor.headless.test_lockstep_actions import project
from tests.executor.warm import warm_session
from tests.fakes.hostile_action import RAISING, SOURCE
from tests.fakes.hostile_values import VALUES
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.zmtp import Groot2
from tests.tree_gardener.programs import program

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(200)]

TREE = "<Act one='{one}' _bts_id='n1'/>"


async def _to_its_end(client: Any, data: dict[str, Any]) -> None:
    assert await client.ask("run", data) == "ack"
    finished = (await client.event("finished", timeout_s=60))["data"]
    assert client.named("fault") == []
    assert finished["status"] == "SUCCESS", finished
    assert "all written" in [log["text"] for log in client.named("log")]


async def test_in_a_session() -> None:
    async with session() as client:
        data = run_data(app(SOURCE, TREE))
        data["application"]["tick_hz"] = 100.0
        await _to_its_end(client, data)


async def test_in_an_exact_session() -> None:
    async with warm_session() as (_, client):
        data = run_data(app(SOURCE, TREE))
        data["universe"] = {"universe": "walled_room", "time": "exact", "seed": 1}
        await _to_its_end(client, data)


RETRY = "<RetryUntilSuccessful num_attempts='-1'><Act _bts_id='n1'/></RetryUntilSuccessful>"


@pytest.mark.parametrize("universe", [{"universe": "x"}, {"universe": "walled_room", "time": "exact"}])
async def test_exceptions_whose_texts_do_harm(universe: dict[str, Any]) -> None:
    data = run_data(app(RAISING, RETRY), on_error="failure") | {"universe": universe}
    async with session() if universe["universe"] == "x" else _exact() as client:
        assert await client.ask("run", data) == "ack"
        finished = (await client.event("finished", timeout_s=60))["data"]
        assert finished["status"] == "SUCCESS", (finished, client.named("fault")[-1])
        assert {fault["kind"] for fault in client.named("fault")} == {"exception"}
        assert all(
            fault["node_id"] == "n1" and fault["file"] == "actions/Act.py" for fault in client.named("fault")
        )
        assert any("half a character \\ud800" in log["text"] for log in client.named("log"))


def test_in_an_exported_program_that_groot2_looks_at(tmp_path: Path) -> None:
    (tmp_path / "actions").mkdir()
    (tmp_path / "actions/Act.py").write_text(SOURCE)
    code, port = '<Code><Action name="Act"/></Code>', free_port()
    (tmp_path / "tree.xml").write_text(
        f'<root BTCPP_format="4"><BehaviorTree ID="T"><Act one="{{one}}"/></BehaviorTree>{code}</root>'
    )
    options = f"tick_hz=100.0, on_finish='repeat', args=['--groot2_port={port}']"
    with program(tmp_path, 12, f"run_tree('tree.xml', node_name='act', actions='actions', {options})") as run:
        groot, board = Groot2.as_soon_as_served(port), {}
        while f"three_{len(VALUES) - 1}" not in board:
            board = msgpack.unpackb(groot.ask("B", b"T")[0], strict_map_key=False)["T"]
        groot.close()
    assert run.returncode == 0, (tmp_path / "said").read_text(errors="replace")[-2000:]
    assert board["two"] == [True]


@contextlib.asynccontextmanager
async def _exact() -> AsyncIterator[Any]:
    async with warm_session() as (_, client):
        yield client


def _project(folder: Path, **files: str) -> Path:
    project(folder, "pass", **{"actions/Act.py": SOURCE}, **files)
    tree = folder / "trees/Main.json"
    tree.write_text(tree.read_text().replace('"type": "Act"', '"type": "Act", "ports": {"one": "{one}"}'))
    return folder


def _cli(*words: str) -> subprocess.CompletedProcess[str]:
    program = str(Path(sys.executable).with_name("bt-studio"))
    return subprocess.run([program, *words], capture_output=True, text=True, check=False)


def test_in_lock_step_with_a_recording_and_a_profile(tmp_path: Path) -> None:
    folder = _project(tmp_path / "act")
    words = ["--lockstep", "--duration", "20", "--record", str(tmp_path / "run.mcap"), "--profile"]
    report = tmp_path / "report.json"
    done = _cli("run", str(folder), *words, "--report", str(report))
    assert done.returncode == 0, done.stderr[-2000:]
    assert "all written" in done.stdout + done.stderr
    found = json.loads(report.read_text())
    assert found["errors"] == []
    assert found["profile"]


def test_in_evaluations(tmp_path: Path) -> None:
    tree = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "a", "drafts": []}
    tree["nodes"] = {"a": {"type": "Act", "ports": {"one": "{one}"}}}
    others = {"trees__MainTree.json": json.dumps(tree)}
    judge = (
        "runs: 1\nuniverse: yard\nduration_s: 20\njudge: {success: [{tree: SUCCESS}, {never: collision}]}\n"
    )
    folder = projects.write(tmp_path / "act", judge, action=SOURCE, name="Act", **others)
    with Cells() as cells:
        for options in ({"recording": str(tmp_path / "run.mcap")}, {"sealed": True}):
            outcome = cells(folder, **options)
            assert (outcome.outcome, outcome.why) == ("success", "all items hold"), options


def test_in_a_behaviour_test(tmp_path: Path) -> None:
    """Each value is compared; those of numpy are equal to plain numbers."""
    wanted = [{"three_0": {"a": 1.5}}, {"three_13": {"a": 2.0}}]
    unlike = [{f"three_{number}": {"a": 7.5}} for number in range(len(VALUES))]
    tests = {
        "format": "bt-studio/test",
        "version": 1,
        "tests": [
            {
                "name": "all values",
                "doubles": {"Act": "real"},
                "ticks": len(VALUES) + 1,
                "expect": [
                    {"at": len(VALUES) + 1, "root": "SUCCESS"},
                    *({"at": "end", "blackboard": each} for each in wanted),
                    *({"never": {"blackboard": each}} for each in unlike),
                ],
            },
        ],
    }
    folder = _project(tmp_path / "act", **{"tests/a.test.yaml": json.dumps(tests)})
    done = _cli("test", str(folder))
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
