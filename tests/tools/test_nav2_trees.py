"""The tool that drives with the trees that Nav2 ships, and the page that it wrote."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from tests.tools.nav2_drive import Row, Shipped, outcome_of, project_of
from tests.tools.nav2_trees import FOLDER, PAGE, line_of, main, page_of
from tests.tools.test_nav2_tables import git
from translator.nav2.distributions import DISTRIBUTIONS

if TYPE_CHECKING:
    from pathlib import Path

    from translator.nav2.distributions import Distribution

TREE = '<root main_tree_to_execute="M"><BehaviorTree ID="M"><Sequence>{body}</Sequence></BehaviorTree></root>'
PLAN = '<ComputePathToPose goal="{goal}" path="{path}"/>'
WAIT = '<Wait wait_duration="0.1"/>'
ROUTE = '<ComputeRoute goal="{goal}" path="{path}" use_poses="true"/>'
SHIPPED = {"humble": 12, "jazzy": 12, "kilted": 14, "lyrical": 15}
ROW = re.compile(
    r"^\| (humble|jazzy|kilted|lyrical) \| `(\w+)` \| (.+?) \| (\d+) \| (.*?) ?\|$", re.MULTILINE
)


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """A repository with a branch for each distribution; only Lyrical's has trees."""
    git(tmp_path, "init", "-q", "-b", "main")
    git(tmp_path, "commit", "-q", "--allow-empty", "-m", "nothing")
    for name in DISTRIBUTIONS:
        git(tmp_path, "branch", name)
    git(tmp_path, "checkout", "-q", "lyrical")
    folder = tmp_path / FOLDER
    folder.mkdir(parents=True)
    (folder / "plan.xml").write_text(TREE.replace("{body}", PLAN + WAIT))
    (folder / "route.xml").write_text(TREE.replace("{body}", PLAN + ROUTE))
    (folder / "notes.txt").write_text("no tree")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-q", "-m", "trees")
    return tmp_path


@pytest.mark.simulation
def test_it_drives_with_each_tree_and_says_what_came_of_it(clone: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    assert main([str(clone), "--page", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    moves = "a node that drives: the tree ends before its goal"
    route = "a route server, with a graph of routes: nobody serves `/compute_route` here"
    assert ROW.findall(text) == [
        ("lyrical", "plan", "SUCCESS, 10.2 m from the goal", "1", moves),
        ("lyrical", "route", "FAILURE, 10.2 m from the goal", "1", route),
    ]
    assert "0 of the 2 trees" in text


def test_a_clone_without_branches_or_trees_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    git(tmp_path, "init", "-q", "-b", "main")
    assert main([str(tmp_path)]) == 2
    assert "has no branch humble" in capsys.readouterr().err
    git(tmp_path, "commit", "-q", "--allow-empty", "-m", "nothing")
    for name in DISTRIBUTIONS:
        git(tmp_path, "branch", name)
    assert main([str(tmp_path)]) == 2
    assert "has no tree" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("status", "left_m", "outcome"),
    [
        ("SUCCESS", 0.3, "arrived"),
        ("SUCCESS", 0.4, "SUCCESS, 0.4 m from the goal"),
        ("RUNNING", 0.1, "RUNNING, 0.1 m from the goal"),
    ],
)
def test_a_tree_arrives_if_it_succeeds_at_its_goal(status: str, left_m: float, outcome: str) -> None:
    assert outcome_of(status, left_m) == outcome


def test_the_project_is_one_of_the_trees_distribution() -> None:
    body = PLAN + '<IsPathValid path="{path}"/>'
    for name in ("humble", "jazzy"):
        project = project_of(Shipped(name, "t", TREE.replace("{body}", body)))
        assert project.settings.ros_distro == name
        assert "actions/IsPathValid.py" in project.files
    with pytest.raises(ValueError, match="humble, t: ComputeRoute"):
        project_of(Shipped("humble", "t", TREE.replace("{body}", PLAN + ROUTE)))


def test_a_tree_without_a_goal_begins_in_an_open_place() -> None:
    own = Shipped("jazzy", "t", TREE.replace("{body}", "<Spin/><Wait/>"))
    assert not own.has_goal
    assert "actions/NavigateToPose.py" in project_of(own).files
    assert Shipped("jazzy", "t", TREE.replace("{body}", PLAN)).has_goal


def test_the_page_has_each_shipped_tree_and_a_reason_where_it_does_not_arrive() -> None:
    text = PAGE.read_text(encoding="utf-8")
    rows = [Row(each[0], each[1], each[2], int(each[3]), each[4]) for each in ROW.findall(text)]
    assert {name: sum(row.distribution == name for row in rows) for name in DISTRIBUTIONS} == SHIPPED
    arrived = [row for row in rows if row.outcome == "arrived"]
    assert len(arrived) >= 45
    assert f"{len(arrived)} of the {len(rows)} trees" in text
    assert all(bool(row.reason) == (row.outcome != "arrived") for row in rows)
    assert not re.search("not supported|stub|Error", "".join(row.reason for row in rows))
    assert all(row.plans > 0 for row in arrived if row.tree != "odometry_calibration")
    commits: dict[Distribution, str] = {}
    for name in DISTRIBUTIONS:
        (commit,) = re.findall(rf"\| `{name}` \| `([0-9a-f]{{40}})` \|", text)
        commits[name] = commit
    assert page_of(rows, commits) == text


def test_the_statuses_of_waypoints_are_set_where_a_tree_reads_them() -> None:
    ports = 'input_goals="{goals}" output_goals="{goals}" input_waypoint_statuses="{waypoint_statuses}"'
    body = f"<RemovePassedGoals {ports}/>{PLAN}"
    project = project_of(Shipped("kilted", "t", TREE.replace("{body}", body)))
    assert "actions/PendingWaypoints.py" in project.files
    plain = project_of(Shipped("kilted", "t", TREE.replace("{body}", PLAN)))
    assert "actions/PendingWaypoints.py" not in plain.files


def test_a_row_is_a_line_of_a_table() -> None:
    assert line_of(Row("jazzy", "t", "arrived", 2, "")) == "| jazzy | `t` | arrived | 2 |  |"
