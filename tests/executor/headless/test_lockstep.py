"""The examples in their simulated worlds, and the report of a run."""

import json
import os
import shutil
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from executor.headless.report import quantiles
from tests.executor.forks import completed
from tests.tree_gardener.debugging.hooked import free_port
from tree_gardener import Status
from tree_gardener.groot.client import Groot2Client, SilenceError
from tree_gardener.groot.protocol import Hook, HookKey, Mode, Position, Unlock
from tree_gardener.groot.remote import RemoteTree

ROOT = Path(__file__).parents[3]
EXAMPLES = ROOT / "examples"

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(300)]


def run(project: Path, duration_s: float, *more: str) -> dict[str, Any]:
    return result_of(completed("tests.executor.headless.lockstep_run", project, duration_s, 1, *more))


def result_of(done: "subprocess.CompletedProcess[str]") -> dict[str, Any]:
    assert done.returncode == 0, done.stderr
    result: dict[str, Any] = json.loads(done.stdout)
    return result


@pytest.fixture(scope="module")
def bump_and_go() -> dict[str, Any]:
    """A run in a fresh process, whose texts have other hashes and whose objects other addresses."""
    script = Path(__file__).with_name("lockstep_run.py")
    done = subprocess.run(
        [sys.executable, str(script), str(EXAMPLES / "laser_bump_and_go"), "60", "1"],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    return result_of(done)


def test_bump_and_go_travels_turns_and_never_collides(bump_and_go: dict[str, Any]) -> None:
    report = bump_and_go["report"]
    assert report["sim_time_s"] == 60
    assert report["ticks"] == 1200
    assert report["distance_m"] > 5
    assert report["collisions"] == 0
    assert report["errors"] == []
    headings = [row[3] for row in report["trajectory"]]
    turns = count_turns(headings)
    assert turns >= 2


def count_turns(headings: list[float]) -> int:
    """Counts the periods in which the heading keeps changing."""
    import math

    moving = [abs(math.remainder(b - a, 2 * math.pi)) > 0.02 for a, b in pairwise(headings)]
    return sum(now and not before for before, now in zip([False, *moving], moving, strict=False))


def test_a_report_counts_its_nodes(bump_and_go: dict[str, Any]) -> None:
    report = bump_and_go["report"]
    counts = {node["path"]: node for node in report["nodes"]}
    root = counts["bump and go"]
    assert root["ticks"] == root["running"] == report["ticks"]
    check = next(node for path, node in counts.items() if path.startswith("CheckObstacle"))
    turn = next(node for path, node in counts.items() if path.startswith("Turn"))
    assert check["success"] == turn["running"] > 0
    assert 0.3 < report["min_range_m"] < 1.1
    assert len(report["trajectory"]) == 600
    assert report["real_time_factor"] > 0


def test_the_same_run_comes_out_the_same(bump_and_go: dict[str, Any]) -> None:
    assert run(EXAMPLES / "laser_bump_and_go", 60)["same"] == bump_and_go["same"]


def test_a_run_that_is_held_at_each_node_and_continued_comes_out_the_same(
    bump_and_go: dict[str, Any],
) -> None:
    held = run(EXAMPLES / "laser_bump_and_go", 60, "held")
    assert held["stops"] > 5 * held["report"]["ticks"]
    assert held["same"] == bump_and_go["same"]


@pytest.mark.timeout(600)
def test_follow_person_keeps_them_in_sight_and_finds_them_again() -> None:
    result = run(EXAMPLES / "visual_follow_person", 62)
    ticks = result["ticks"]
    first = next(t for t, _, is_seen in ticks if is_seen)
    window = [(t, away, is_seen) for t, away, is_seen in ticks if first <= t < first + 60]
    assert len(window) == 1200
    assert sum(is_seen for _, _, is_seen in window) / len(window) >= 0.8
    lost = [t for (t, _, now), (_, _, before) in zip(window[1:], window, strict=False) if before and not now]
    found = [t for (t, _, now), (_, _, before) in zip(window[1:], window, strict=False) if now and not before]
    # The person walks behind the screen each 39 s; the window may end while it is there again.
    assert len(found) == 1 <= len(lost) <= 2
    assert found[0] > lost[0] + 1
    catches_up = found[0] + 3  # the person has walked on meanwhile
    assert all(0.8 <= away <= 4.0 for _, away, is_seen in window if is_seen)
    assert all(away <= 3.0 for t, away, is_seen in window if is_seen and not found[0] <= t < catches_up)
    assert result["report"]["collisions"] == 0


def test_an_action_that_raises_is_reported_with_its_line(tmp_path: Path) -> None:
    project = tmp_path / "project"
    shutil.copytree(EXAMPLES / "laser_bump_and_go", project)
    source = project / "actions" / "Forward.py"
    source.write_text(source.read_text().replace("twist = Twist()", 'raise RuntimeError("flat battery")'))
    report = run(project, 5)["report"]
    [error] = report["errors"]
    assert error["file"] == "actions/Forward.py"
    assert "flat battery" in error["message"]
    assert report["root_status"] == "FAILURE"
    assert report["ticks"] < 10


def test_a_port_changes_the_speed(tmp_path: Path) -> None:
    project = tmp_path / "project"
    shutil.copytree(EXAMPLES / "laser_bump_and_go", project)
    diagram = project / "trees" / "MainTree.json"
    diagram.write_text(diagram.read_text().replace('"lin_speed": "0.3"', '"lin_speed": "0.15"'))
    assert run(project, 5)["report"]["distance_m"] == pytest.approx(0.15 * 5, rel=0.1)


def test_groot2_holds_a_run_until_it_continues_it() -> None:
    port = free_port()
    example = str(EXAMPLES / "laser_bump_and_go")
    command = ["run", example, "--lockstep", "--duration", "3600", "--groot2", str(port)]
    process = subprocess.Popen([sys.executable, "-m", "backend.cli.main", *command], cwd=ROOT)
    try:
        with Groot2Client("127.0.0.1", port) as client:
            root = first_answer(client, process).nodes[0].uid
            client.listen()
            key = HookKey(root, Position.BEFORE)
            client.insert(
                [Hook(key, Mode.BREAKPOINT, once=False, desired_status=Status.SKIPPED, enabled=True)]
            )
            for _ in range(3):
                stops_at(client, root)
                held = client.statuses()
                assert client.statuses() == held
                client.unlock(Unlock(key, Status.SKIPPED, remove_when_done=False))
    finally:
        process.kill()
        process.wait()


def first_answer(client: Groot2Client, process: "subprocess.Popen[bytes]") -> RemoteTree:
    while process.poll() is None:
        try:
            return client.tree()
        except SilenceError:
            continue
    raise AssertionError("the run has ended")


def stops_at(client: Groot2Client, uid: int) -> None:
    deadline_s = time.monotonic() + 60
    while client.reached() != [uid]:
        assert time.monotonic() < deadline_s
        client.statuses()  # a client that asks nothing counts as gone


def test_quantiles() -> None:
    assert quantiles([i / 1000 for i in range(1, 101)]) == {"p50": 50.0, "p95": 95.0, "max": 100.0}
    assert quantiles([]) == {"p50": 0.0, "p95": 0.0, "max": 0.0}
