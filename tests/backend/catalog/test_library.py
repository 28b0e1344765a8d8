"""The built-in library: each behaviour works as described, in simulation, and no file is missing."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from backend.catalog.library import behaviours, files_of
from backend.catalog.queries import UNIVERSES

ROOT = Path(__file__).parents[3]
Runs = dict[str, dict[str, Any]]


def test_every_behaviour_is_described_in_both_languages_and_has_its_files(api: Any) -> None:
    items = {item["id"]: item for item in api.get("catalog/behaviours")["items"]}
    assert len(items) >= 14
    for behaviour_id, item in items.items():
        assert item["summary"].keys() == item["doc"].keys() == {"en", "es"}
        assert f"trees/{behaviour_id}.json" in item["files"]
        assert item["diagram"]["id"] == behaviour_id
        assert (UNIVERSES / f"{item['universe']}.yaml").is_file()
        assert all(port["description"] for port in item["diagram"]["ports"])


def test_examples_hold_the_librarys_files_as_they_are() -> None:
    """An example is a separate project with copies of the files.

    A correction of the library must be made there, too.
    """
    library = {path: text for behaviour in behaviours() for path, text in behaviour.files.items()}
    copies = {
        file: file.relative_to(example).as_posix()
        for example in (ROOT / "examples").iterdir()
        for file in example.rglob("*.*")
        if file.relative_to(example).as_posix() in library
    }
    assert len(copies) >= 20
    assert [
        str(file) for file, path in copies.items() if file.read_text(encoding="utf-8") != library[path]
    ] == []


def test_a_behaviour_brings_the_subtrees_below_it_and_their_actions() -> None:
    assert set(files_of("Docking")) == {
        "actions/ApproachUntilNear.py",
        "actions/LookAround.py",
        "actions/SeesColor.py",
        "actions/SteerTowards.py",
        "trees/ColorFollowing.json",
        "trees/Docking.json",
        "trees/SearchColor.json",
    }


@pytest.fixture(scope="module")
def runs() -> Runs:
    done = subprocess.run(
        [sys.executable, "-m", "tests.backend.catalog.library_runs"],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    runs: Runs = json.loads(done.stdout)
    return runs


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_no_behaviour_is_left_out_and_none_raises(runs: Runs) -> None:
    assert set(runs) == {behaviour.id for behaviour in behaviours()}
    assert [run["errors"] for run in runs.values() if run["errors"]] == []


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_drive_forward_covers_its_distance(runs: Runs) -> None:
    x, y, yaw = ended(runs["DriveForward"], "SUCCESS")
    assert (x, y, yaw) == pytest.approx((1.5, 0, 0), abs=0.05)


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_turn_by_turns_right_by_three_quarters(runs: Runs) -> None:
    _, _, yaw = ended(runs["TurnBy"], "SUCCESS")
    assert math.degrees(yaw) == pytest.approx(90, abs=4)
    headings = [row[3] for row in runs["TurnBy"]["trajectory"]]
    steps = [math.remainder(b - a, math.tau) for a, b in pairwise(headings)]
    assert math.degrees(sum(steps)) == pytest.approx(-270, abs=4)


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_rotate_to_looks_where_it_shall(runs: Runs) -> None:
    _, _, yaw = ended(runs["RotateTo"], "SUCCESS")
    assert math.degrees(yaw) == pytest.approx(135, abs=4)


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_go_to_reaches_the_point(runs: Runs) -> None:
    x, y, _ = ended(runs["GoTo"], "SUCCESS")
    assert math.dist((x, y), (-1, 1)) < 0.1


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_wall_following_goes_along_the_walls_and_touches_none(runs: Runs) -> None:
    run = runs["WallFollowing"]
    ended(run, "RUNNING")
    assert run["collisions"] == 0
    assert run["distance_m"] > 4
    late = [row for row in run["trajectory"] if row[0] > 10]
    away = [2.45 - max(abs(x), abs(y)) for _, x, y, _ in late]
    assert max(away) < 1.1
    assert min(away) > 0.3


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_obstacle_avoidance_drives_on_and_touches_nothing(runs: Runs) -> None:
    run = runs["ObstacleAvoidance"]
    ended(run, "RUNNING")
    assert run["collisions"] == 0
    assert run["distance_m"] > 3


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_line_following_stays_on_the_bent_line(runs: Runs) -> None:
    x, y, _ = ended(runs["LineFollowing"], "RUNNING")
    assert x > 2
    assert y == pytest.approx(0.06 * ((x - 0.5) / 0.98) ** 2, abs=0.2)


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_color_following_ends_in_front_of_the_post(runs: Runs) -> None:
    x, y, _ = ended(runs["ColorFollowing"], "SUCCESS")
    assert runs["ColorFollowing"]["collisions"] == 0
    assert math.dist((x, y), (2.5, 0.4)) < 1.8


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_search_color_turns_until_the_post_is_seen(runs: Runs) -> None:
    _, _, yaw = ended(runs["SearchColor"], "SUCCESS")
    bearing = math.atan2(-1.0, -1.5)
    assert abs(math.remainder(yaw - bearing, math.tau)) < 0.7


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_a_person_in_sight_is_reported(runs: Runs) -> None:
    ended(runs["PersonInSight"], "SUCCESS")


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_patrol_passes_each_point_in_order(runs: Runs) -> None:
    run = runs["Patrol"]
    x, y, _ = ended(run, "SUCCESS")
    assert math.dist((x, y), (0, 0)) < 0.1
    times = [
        min((math.dist(row[1:3], point), row[0]) for row in run["trajectory"]) for point in ((1, 0), (1, 1))
    ]
    assert all(distance < 0.1 for distance, _ in times)
    assert times[0][1] < times[1][1]


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_docking_stops_in_front_of_the_station(runs: Runs) -> None:
    run = runs["Docking"]
    x, y, _ = ended(run, "SUCCESS")
    assert run["collisions"] == 0
    assert 0.4 < math.dist((x, y), (-2.0, 0.5)) < 1.0


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_push_object_brings_the_crate_to_the_goal(runs: Runs) -> None:
    run = runs["PushObject"]
    ended(run, "SUCCESS")
    assert math.dist(run["bodies"]["crate"][:2], (1.8, 0.3)) < 0.2


@pytest.mark.simulation
@pytest.mark.timeout(400)
def test_wait_topic_succeeds_with_the_first_message(runs: Runs) -> None:
    ended(runs["WaitTopic"], "SUCCESS")
    assert runs["WaitTopic"]["sim_time_s"] < 2


def ended(run: dict[str, Any], status: str) -> tuple[float, float, float]:
    """Returns the final position of the robot, after a run that ended as expected."""
    assert run["root_status"] == status
    _, x, y, yaw = run["trajectory"][-1]
    return x, y, yaw
