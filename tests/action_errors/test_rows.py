"""What an error of an action does: each row of the table in each way to run, one test a cell."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import pytest

from tests.action_errors import timed
from tests.action_errors.rows import MESSAGE, Row, marks_of, rows
from tests.deadline import DEADLINE_S
from tests.domains import own_domain_id
from tests.executor.evaluation.one_by_one import Cells
from tests.executor.session_client import run_data
from tests.executor.warm import warm_session
from tests.tree_gardener.programs import Peer, program
from translator import open_path, to_app_zip
from tree_gardener import Tree
from tree_gardener.testing import LeafModel, Suite, read_tests

if TYPE_CHECKING:
    from collections.abc import Iterator

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

pytestmark = [
    pytest.mark.simulation,
    pytest.mark.timeout(300),
    pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning"),
]

ROOT: Final = Path(__file__).parents[2]
DOMAIN_ID: Final = own_domain_id()
PAGE: Final = ROOT / "docs/explanation/action-errors.md"
UNCONFIGURED, INACTIVE = 1, 2
SUCCEEDED, ABORTED = 4, 6
ROWS: Final = rows()
each_row = pytest.mark.parametrize("row", ROWS, ids=str)


@pytest.fixture
def marks(tmp_path: Path) -> Path:
    return tmp_path / "marks"


@pytest.fixture
def peer() -> Iterator[Peer]:
    """Returns a new participant a test: one that has lost the graph would fail all tests after it."""
    made = Peer(DOMAIN_ID)
    yield made
    made.close()


@pytest.fixture(scope="module")
def cells() -> Iterator[Cells]:
    with Cells() as made:
        yield made


def package(row: Row, folder: Path, marks: Path) -> None:
    """Writes what `main.py` of an exported package runs."""
    (folder / "tree.xml").write_text(row.xml())
    (folder / "actions").mkdir()
    for name, source in row.sources(marks).items():
        (folder / "actions" / f"{name}.py").write_text(source)


def check_said(row: Row, said: str) -> None:
    """The error, or what is logged, is there with file and line."""
    assert MESSAGE in said
    assert f"Subject.py:{row.line}" in said


@each_row
def test_a_plain_package(row: Row, tmp_path: Path, marks: Path) -> None:
    package(row, tmp_path, marks)
    call = f"run_tree('tree.xml', node_name='plain', actions='actions', args=[], on_error={row.on_error!r})"
    with program(tmp_path, DOMAIN_ID, call) as process:
        assert process.wait(DEADLINE_S) == (3 if row.is_error else 0)
    assert marks_of(marks) == row.marks
    check_said(row, (tmp_path / "said").read_text())


@each_row
def test_a_lifecycle_package(row: Row, tmp_path: Path, marks: Path, peer: Peer) -> None:
    from tests.tree_gardener.test_ros_lifecycle import Manager

    package(row, tmp_path, marks)
    call = (
        f"manage_tree('tree.xml', node_name='managed', actions='actions', args=[], on_error={row.on_error!r})"
    )
    with program(tmp_path, DOMAIN_ID, call) as process:
        manager = Manager(peer, tmp_path)
        manager.begin()
        wanted = UNCONFIGURED if row.is_error else INACTIVE
        peer.until(lambda: manager.state() == wanted)
        manager.close()
    assert process.returncode == 0, "stopped by a signal; the node outlived the error"
    assert marks_of(marks) == row.marks
    check_said(row, (tmp_path / "said").read_text())


@each_row
def test_a_server_package(row: Row, tmp_path: Path, marks: Path, peer: Peer) -> None:
    from tests.tree_gardener.test_ros_server import Client

    package(row, tmp_path, marks)
    call = (
        f"serve_trees('tree.xml', node_name='served', actions='actions', args=[], on_error={row.on_error!r})"
    )
    with program(tmp_path, DOMAIN_ID, call) as process:
        client = Client(peer, tmp_path)
        for _ in range(2):  # the server outlives the error
            status, _, message = client.run("Main")
            assert status == (ABORTED if row.is_error else SUCCEEDED)
            assert (MESSAGE in message) == row.is_error
        client.client.destroy()
    assert process.returncode == 0
    assert marks_of(marks) == row.marks * 2
    check_said(row, client.said())


@each_row
def test_a_run_in_lock_step(row: Row, tmp_path: Path, marks: Path) -> None:
    folder, report = row.project(tmp_path / "project", marks), tmp_path / "report.json"
    words = ["run", str(folder), "--lockstep", "--duration", "4", "--report", str(report)]
    done = subprocess.run(
        [sys.executable, "-m", "backend.cli.main", *words],
        *(), cwd=ROOT, capture_output=True, text=True, timeout=DEADLINE_S, check=False,
    )  # fmt: skip
    said = json.loads(report.read_text())
    assert said["root_status"] == ("FAILURE" if row.is_error else "SUCCESS")
    assert done.returncode == (0 if row.row == "terminate" else 1), "1 if an action raised"
    assert marks_of(marks) == row.marks
    check_said(row, done.stdout + done.stderr)


@each_row
def test_an_evaluation(row: Row, tmp_path: Path, marks: Path, cells: Cells) -> None:
    found = cells(row.project(tmp_path / "project", marks))
    assert found.outcome == ("error" if row.is_error else "success")
    assert marks_of(marks) == row.marks
    if row.is_error:
        assert found.why.startswith(f"actions/Subject.py:{row.line}:1: ")
        assert MESSAGE in found.why


@each_row
@pytest.mark.parametrize("time", ["real", "exact"])
async def test_a_session(row: Row, time: str, tmp_path: Path, marks: Path) -> None:
    import base64

    project = open_path(row.project(tmp_path / "project", marks))
    data = run_data(base64.b64encode(to_app_zip(project)).decode(), on_finish="stop", on_error=row.on_error)
    if time == "exact":
        data["universe"]["time"] = time
    async with warm_session() as (_, client):
        assert await client.ask("run", data) == "ack"
        finished = (await client.event("finished"))["data"]
        assert finished["reason"] == ("action_raised" if row.is_error else "root_finished")
        faults, logs = client.named("fault"), client.named("log")
        if row.row == "terminate":
            assert faults == []
            [text] = [log["text"] for log in logs if MESSAGE in log["text"]]
            assert text.endswith(f"at actions/Subject.py:{row.line}")
        else:
            [fault] = faults
            assert (fault["file"], fault["line"]) == ("actions/Subject.py", row.line)
            assert MESSAGE in fault["message"]
        await client.comes_to("visualization_ready")
    assert marks_of(marks) == row.marks


def result_of(xml: str, sources: dict[str, str], kinds: dict[str, str], on_error: str) -> Any:
    """Runs a behaviour test whose leaves are real."""
    models = {
        name: LeafModel(kind, children=(1, None) if kind == "control" else None)
        for name, kind in kinds.items()
    }
    suite = Suite(xml, models, sources=sources, on_error=on_error)
    doubles = {name: "real" for name in kinds if f"<{name}" in xml}
    test = {"name": "t", "ticks": 20, "doubles": doubles, "expect": [{"at": "end", "root": "SUCCESS"}]}
    content = {"format": "bt-studio/test", "version": 1, "tests": [test]}
    [case], problems = read_tests(content, "tests/t.test.yaml", suite=suite)
    assert problems == []
    return suite.run(case)


@pytest.mark.parametrize("row", [row for row in ROWS if row.row in {"update", "terminate"}], ids=str)
def test_a_behaviour_test(row: Row, marks: Path, caplog: pytest.LogCaptureFixture) -> None:
    kinds = dict.fromkeys(("Subject", "Ends", "Waits"), "StatefulAction")
    result = result_of(row.xml().partition("<Code>")[0] + "</root>", row.sources(marks), kinds, row.on_error)
    assert result.passed is not row.is_error
    assert marks_of(marks) == row.marks
    check_said(row, str(result.failures[0]) if row.is_error else caplog.text)


@pytest.mark.parametrize("row", [row for row in ROWS if row.row in timed.UPDATES], ids=str)
def test_a_behaviour_test_with_a_timer(row: Row, marks: Path) -> None:
    kinds = {"Subject": "control", "Waits": "StatefulAction"}
    result = result_of(timed.xml(row), timed.sources(row, marks), kinds, row.on_error)
    assert result.passed is not row.is_error
    assert marks_of(marks) == ["waits INVALID"]


def test_no_callback_without_an_owner_exists_in_behaviour_tests() -> None:
    tree = Tree.from_xml(
        timed.xml(ROWS[2]).replace("Subject>", "Inverter>").replace("<Waits/>", "<AlwaysSuccess/>")
    )
    assert tree.timers.heap == [], "only nodes start timers, and there is no ROS"


def test_the_page_has_the_same_rows() -> None:
    page = PAGE.read_text().replace("  ", " ")
    for row in ROWS:
        assert f"| {row.raises} | `{row.on_error}` | {row.what} |" in page or (
            row.row in {"callback-idle", "callback-unowned", "terminate"}
            and f"| {row.raises} | any | {row.what} |" in page
        )
