"""No test can hurt the one that asked for it, nor the tests after it."""

from __future__ import annotations

import pytest

from tests.tree_gardener.testing.trees_under_test import MODELS, document
from tree_gardener.testing.apart import bounded, run_apart
from tree_gardener.testing.cases import Case
from tree_gardener.testing.job import Job, TestFile

HEAD = "import py_trees, os, time\nclass Turn(py_trees.behaviour.Behaviour):\n    def update(self):\n        "

STUBBORN = """while True:
            try:
                while True: pass
            except Exception: pass"""


def results(code, **options):
    expect = [{"at": 1, "root": "SUCCESS"}]
    tests = [
        {"name": "hostile", "ticks": 1, "doubles": {"Turn": "real"}, "expect": expect},
        {"name": "after", "ticks": 1, "doubles": {"Turn": "SUCCESS"}, "expect": expect},
    ]
    content = {"format": "bt-studio/test", "version": 1, "tests": tests}
    job = Job([TestFile("f", content)], MODELS, xml=document("<Turn/>"), sources={"Turn": HEAD + code})
    cases, problems = job.cases(job.suite())
    assert problems == []
    told: list = []
    found = run_apart(job, cases, told=told.append, **options)
    assert told == found
    assert [result.name for result in found] == ["hostile", "after"]
    assert found[1].passed
    return [failure.message for failure in found[0].failures]


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("os._exit(0)", "ended before its result"),
        ("os.kill(os.getpid(), 9)", "ended before its result"),
        ("while True: pass", "more than 0.3 s of processor time"),
        (
            STUBBORN,
            "processor time",
        ),
        ("time.sleep(1000)", "did not end within 2 s"),
        ("x = bytearray(1 << 30)", "more memory than it may have"),
        ("print('{}')", "returned nothing"),
        ("raise SystemExit(0)", "called sys.exit(0)"),
    ],
)
def test_a_hostile_leaf_is_one_failure(code, said):
    [message] = results(code, wall_s=2.0, processor_s=0.3)
    assert said in message


def test_an_honest_one_passes():
    assert results("return py_trees.common.Status.SUCCESS") == []


def test_memory_that_runs_out_outside_of_an_action_is_a_failure():
    def run():
        raise MemoryError

    case = Case("t", "", 1, 20.0, (), ())
    assert "256 MB of memory" in bounded(run, case).failures[0].message
