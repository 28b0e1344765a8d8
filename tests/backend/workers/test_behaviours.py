"""Behaviour tests in a worker: no Python of the project, and an end for all of them together."""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.workers import behaviours
from backend.workers.behaviours import problems_of_tests, run_coverage, run_tests
from backend.workers.jobs import JOBS
from translator import behaviour_tests, load
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


def test_the_report_of_a_project_has_the_problems_of_its_tests(files):
    """They are those of the terminal: the same code, sentence and place."""
    files["tests/x.test.yaml"] = (
        f"{HEAD}  - {{name: a, ticks: '3', expect: [{{at: 1, root: RUNNING}}]}}".encode()
    )
    [found] = JOBS["report"](files=files)["diagnostics"]
    [problem] = run_tests(files)["problems"]
    assert found == problem
    assert (found["file"], found["line"]) == ("tests/x.test.yaml", 4)
    assert "write 3" in found["message"] + found["hint"]


def without_end(*_, **__):
    while True:
        pass


def broken(*_, **__):
    raise RecursionError


@pytest.mark.parametrize(
    ("to_job", "reason"), [(broken, "RecursionError"), (without_end, "more than 0.01 s of processor time")]
)
def test_tests_that_cannot_be_checked_cost_no_more_than_their_part_of_the_report(
    files, monkeypatch, to_job, reason
):
    monkeypatch.setattr(behaviours, "CHECK_S", 0.01)
    monkeypatch.setattr(behaviour_tests, "to_job", to_job)
    report = JOBS["report"](files=files)
    [found] = report["diagnostics"]
    assert (found["code"], found["severity"]) == ("BT0025", "warning")
    assert reason in found["message"]
    assert report["actions"]


def test_the_report_of_a_project_with_tests_checks_it_once(files, monkeypatch):
    monkeypatch.setattr(behaviour_tests, "check", broken)
    assert JOBS["report"](files=files)["diagnostics"] == []


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


WRONG = b"""format: bt-studio/test
version: 1
tests:
  - {name: form, ticks: yes, expect: [{at: 1, root: RUNNING}]}
  - {name: names, ticks: 1, doubles: {Nobody: SUCCESS}, expect: [{at: 1, node: Noone, status: RUNNING}]}
"""


def test_what_keeps_tests_from_a_run_is_known_without_a_tick(files):
    assert problems_of_tests(load(files)) == []
    files["tests/x.test.yaml"] = WRONG
    found = problems_of_tests(load(files))
    assert [(item.code, item.file, item.line) for item in found] == [
        ("TG902", "tests/x.test.yaml", 4),
        ("TG905", "tests/x.test.yaml", 5),
        ("TG905", "tests/x.test.yaml", 5),
    ]
    del files["actions/Turn.py"]  # names cannot be looked up in trees with errors, the form can
    assert problems_of_tests(load(files)) == found[:1]
