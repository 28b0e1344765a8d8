from __future__ import annotations

import json

from tests.tree_gardener.testing.trees_under_test import MODELS, document
from tree_gardener.testing.job import Job, TestFile
from tree_gardener.testing.packaged import PackagedTests


def test_the_tests_of_a_package_find_its_trees_and_actions(tmp_path):
    expect = [{"at": 1, "root": "SUCCESS"}]
    tests = [
        {"name": "holds", "ticks": 1, "doubles": {"Turn": "real"}, "expect": expect},
        {"name": "does not", "ticks": 1, "doubles": {"Turn": "FAILURE"}, "expect": expect},
        {"name": "cannot be read"},
    ]
    content = {"format": "bt-studio/test", "version": 1, "tests": tests}
    for folder in ("test", "trees", "robot/actions"):
        (tmp_path / folder).mkdir(parents=True)
    job = Job([TestFile("tests/t.test.yaml", content)], MODELS)
    (tmp_path / "test" / "behaviour_tests.json").write_text(json.dumps(job.to_json()))
    (tmp_path / "trees" / "robot.xml").write_text(document("<Turn/>"))
    source = "import py_trees\nclass Turn(py_trees.behaviour.Behaviour):\n    def update(self):\n        "
    (tmp_path / "robot/actions/Turn.py").write_text(f"{source}return py_trees.common.Status.SUCCESS\n")
    found = PackagedTests(tmp_path / "test", "robot")
    assert found.parameters() == ["tests/t.test.yaml: holds", "tests/t.test.yaml: does not"]
    assert len(found.problems) == 1
    assert found.failures("tests/t.test.yaml: holds") == []
    [said] = found.failures("tests/t.test.yaml: does not")
    assert "wanted SUCCESS, got FAILURE" in said
