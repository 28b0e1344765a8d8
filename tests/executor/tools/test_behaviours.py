"""Behaviour tests with real leaves in a process of their own: results, limits, and what the Python can do."""

from __future__ import annotations

import json

from executor.tools.behaviours import run_behaviours, run_job
from tests.cli.typed import ROOT
from translator import load
from translator.archive import read_folder
from translator.behaviour_tests import to_job

HEAD = "format: bt-studio/test\nversion: 1\ntests:\n"
REAL = "doubles: {Turn: real, '*': SUCCESS}, ticks: 1, expect: [{at: 1, root: RUNNING}]}\n"
LEAF = """import time
import py_trees
class Turn(py_trees.behaviour.Behaviour):
    def update(self):
        {body}
        return py_trees.common.Status.RUNNING
"""


def asked(body: str, tests: int = 2) -> dict:
    files = dict(read_folder(ROOT / "examples" / "laser_bump_and_go"))
    files["actions/Turn.py"] = LEAF.format(body=body).encode()
    names = [f"real {number}" for number in range(tests)]
    files["tests/x.test.yaml"] = (HEAD + "".join(f"  - {{name: {name}, {REAL}" for name in names)).encode()
    job, _ = to_job(load(files), real=True)
    return {"job": job, "run": [["tests/x.test.yaml", name] for name in names]}


def test_only_the_tests_that_are_asked_for_run():
    document = asked("pass")
    document["run"].pop()
    [result] = run_job(document)["results"]
    assert (result["name"], result["passed"]) == ("real 0", True)


def test_a_leaf_that_ends_its_process_is_one_failure():
    results = run_job(asked("import os; os._exit(0)"))["results"]
    assert [result["passed"] for result in results] == [False, False]
    assert "ended before its result" in results[0]["failures"][0]["message"]


def test_a_leaf_that_waits_ends_at_the_limit_and_the_rest_is_not_run():
    results = run_job(asked("time.sleep(1000)", tests=3), limit_s=0.0, wall_s=1.0)["results"]
    assert [result["passed"] for result in results] == [False]
    assert "did not end within 1 s" in results[0]["failures"][0]["message"]


async def test_the_child_answers_with_json_or_nothing():
    answer = json.loads(await run_behaviours(json.dumps(asked("pass", tests=1))))
    assert [result["passed"] for result in answer["results"]] == [True]
    assert await run_behaviours("no job") == ""
