from __future__ import annotations

import json

from tests.tree_gardener.testing.trees_under_test import MODELS, document
from tree_gardener.testing.job import Job, Places, TestFile, placer

CONTENT = {
    "format": "bt-studio/test",
    "version": 1,
    "tests": [
        {"name": "t", "ticks": 1, "doubles": {"Drive": "SUCCESS"}, "expect": [{"at": 1, "root": "SUCCESS"}]}
    ],
}


def test_a_job_survives_the_way_through_json():
    places: Places = {("tests", 0): (4, 5)}
    job = Job(
        [TestFile("f", CONTENT, places)], MODELS, {"Main": {"x": "1"}}, 10.0, document("<Drive/>"), {"A": "a"}
    )
    again = Job.from_json(json.loads(json.dumps(job.to_json())))
    assert again == job
    suite = again.suite()
    [case], problems = again.cases(suite)
    assert problems == []
    assert (case.line, case.tick_hz) == (4, 10.0)
    assert suite.run(case).passed


def test_the_place_of_a_part_is_that_of_the_nearest_part_around_it():
    place = placer({("a",): (2, 1), ("a", 0): (3, 4)})
    assert [place(path) for path in (("a", 0, "x"), ("a", 7), ("b",))] == [(3, 4), (2, 1), (1, 1)]
