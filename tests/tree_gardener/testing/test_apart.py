"""No test can hurt the one that asked for it, nor the tests after it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.deadline import DEADLINE_S
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
    # Only the one that waits is ended by the clock: a busy machine gives the others their time late.
    [message] = results(code, wall_s=2.0 if "did not end" in said else DEADLINE_S, processor_s=0.3)
    assert said in message


def test_an_honest_one_passes():
    assert results("return py_trees.common.Status.SUCCESS") == []


def test_memory_that_runs_out_outside_of_an_action_is_a_failure():
    def run():
        raise MemoryError

    case = Case("t", "", 1, 20.0, (), ())
    assert "256 MB of memory" in bounded(run, case).failures[0].message


FORK = """child = os.fork()
        if child == 0:
            {leave}
            if os.fork() == 0:
                open({file!r} + "3", "w").write(str(os.getpid()))
                os.rename({file!r} + "3", {file!r} + "2")
            time.sleep(600)
        while not os.path.exists({file!r} + "2"):
            time.sleep(0.001)
        open({file!r}, "w").write(str(child))
        {then}"""


ENDED = ["the process of the test ended before its result"]


@pytest.mark.parametrize(
    ("leave", "then", "said"),
    [
        ("pass", "return py_trees.common.Status.SUCCESS", []),
        ("os.setsid()", "return py_trees.common.Status.SUCCESS", []),
        ("os.setsid()", "os._exit(0)", ENDED),
        ("os.setsid()", "os.killpg(0, 9)", ENDED),
        ("os.setsid()", "time.sleep(1000)", ["the test did not end within 2 s"]),
    ],
)
def test_forks_delay_nothing_and_end_with_the_tests(tmp_path, leave, then, said):
    file = tmp_path / "child"
    code = FORK.format(file=str(file), then=then, leave=leave)
    assert results(code, wall_s=2.0 if "sleep" in then else 2 * DEADLINE_S) == said
    for written in (file, Path(f"{file}2")):
        assert not _runs(int(written.read_text())), "the fork lives on"


def _runs(pid):
    """Returns whether a process runs; a zombie does not."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text()
    except FileNotFoundError:
        return False
    return text.rpartition(") ")[2][0] not in "ZX"
