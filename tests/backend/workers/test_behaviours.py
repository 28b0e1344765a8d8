"""Behaviour tests in a worker: no Python of the project, and an end for all of them together."""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.workers.behaviours import run_coverage, run_tests
from backend.workers.jobs import JOBS
from translator.archive import read_folder

ROOT = Path(__file__).resolve().parents[3]
HEAD = "format: bt-studio/test\nversion: 1\ntests:\n"


@pytest.fixture
def files():
    return dict(read_folder(ROOT / "examples" / "laser_bump_and_go"))


def test_the_results_are_an_answer(files):
    answer = JOBS["behaviour_tests"](files=files)
    assert [test["outcome"] for test in answer["tests"]] == ["passed"] * 3
    assert (answer["problems"], answer["coverage"]["share"]) == ([], 1.0)


def test_a_failure_names_the_block(files):
    tree = "trees/MainTree.json"
    files[tree] = files[tree].replace(b'"ReactiveSequence"', b'"Sequence"')
    failed = [test for test in run_tests(files)["tests"] if test["outcome"] == "failed"]
    failure = failed[0]["failures"][0]
    assert (failure["tree"], failure["node_id"], failure["tick"]) == ("MainTree", "n5", 6)
    assert failure["path"][0] == {"name": "bump and go", "status": "RUNNING"}


def test_no_python_of_the_project_runs(files, tmp_path):
    planted = tmp_path / "planted"
    files["actions/Turn.py"] = (
        b"import pathlib\npathlib.Path(%r).touch()\n" % str(planted) + files["actions/Turn.py"]
    )
    rest = "ticks: 1, expect: [{at: 1, root: RUNNING}]}\n"
    files["tests/bump_and_go.test.yaml"] = (
        f"{HEAD}  - {{name: real, doubles: {{Turn: real, '*': SUCCESS}}, {rest}"
        f"  - {{name: doubled, doubles: {{CheckObstacle: SUCCESS, Turn: RUNNING}}, {rest}"
    ).encode()
    assert [test["outcome"] for test in run_tests(files)["tests"]] == ["needs_python", "passed"]
    assert not planted.exists()


def test_all_tests_together_have_an_end(files):
    outcomes = [test["outcome"] for test in run_tests(files, processor_s=0.0)["tests"]]
    assert outcomes == ["not_run"] * 3


def test_a_file_that_cannot_be_read_is_a_problem_like_others(files):
    files["tests/x.test.yaml"] = b"a: [\n"
    [problem] = run_tests(files)["problems"]
    assert (problem["code"], problem["file"], problem["line"]) == ("TG900", "tests/x.test.yaml", 2)


def test_a_project_with_errors_is_refused(files):
    del files["actions/Turn.py"]
    assert JOBS["behaviour_tests"](files=files)["refused"][0]["code"].startswith("BT")


def test_runs_of_the_whole_tree_cover_blocks_and_results(files):
    """Paths are those of the tree that runs; branches and halts are unknown, and not asked for."""
    paths = {"": "R", "CheckObstacle::4": "SF", "Turn::5": "R", "not/there": "S", "Forward::6": ""}
    answer = JOBS["run_coverage"](files=files, seen=paths)
    nodes = answer["trees"]["MainTree"]["nodes"]
    items = {node["name"]: node["items"] for node in nodes.values()}
    assert items["CheckObstacle"] == {"ticked": True, "SUCCESS": True, "FAILURE": True}
    assert items["Turn"] == {"ticked": True, "RUNNING": True}
    assert items["Forward"] == {"ticked": False, "RUNNING": False}
    assert 0 < answer["share"] < 1
    assert run_coverage(files, {})["share"] == 0
