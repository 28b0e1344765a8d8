"""500 behaviour tests of 60 ticks on *bump and go*: in this process, and in one of their own.

Run alone with `python -m tests.benchmarks behaviours`. The target is at most 2 s.
"""

from __future__ import annotations

import time
from pathlib import Path

from translator import open_path
from translator.behaviour_tests import to_job
from tree_gardener.testing.apart import run_apart
from tree_gardener.testing.job import Job, TestFile

TESTS, TICKS, TARGET_S = 500, 60, 2.0
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "laser_bump_and_go"


def main() -> None:
    """Prints the times."""
    job = Job.from_json(to_job(open_path(EXAMPLE))[0])
    tests = [
        {
            "name": f"test {number}",
            "doubles": {
                "CheckObstacle": [{"status": "SUCCESS", "times": 1 + number % 50}, "FAILURE"],
                "Turn": "RUNNING",
                "Forward": "RUNNING",
            },
            "ticks": TICKS,
            "expect": [
                {"at": f"1..{1 + number % 50}", "node": "Turn", "status": "RUNNING"},
                {
                    "never": {
                        "node": "Forward",
                        "status": "RUNNING",
                        "while": {"node": "Turn", "status": "RUNNING"},
                    }
                },
                {"at": "end", "root": "RUNNING", "ticked": {"CheckObstacle": TICKS}},
            ],
        }
        for number in range(TESTS)
    ]
    document = {"format": "bt-studio/test", "version": 1, "tests": tests}
    job = Job([TestFile("many", document)], job.nodes, job.ports, job.tick_hz, job.xml)
    start_s = time.perf_counter()
    suite = job.suite()
    cases, problems = job.cases(suite)
    assert len(cases) == TESTS, problems
    read_s = time.perf_counter() - start_s
    start_s = time.perf_counter()
    assert all(suite.run(case).passed for case in cases)
    run_s = time.perf_counter() - start_s
    start_s = time.perf_counter()
    assert all(result.passed for result in run_apart(job, cases))
    apart_s = time.perf_counter() - start_s
    print(
        f"{TESTS} tests of {TICKS} ticks: reading {read_s:.2f} s, running {run_s:.2f} s, target {TARGET_S} s"
    )
    print(f"in a process of their own, with its start and its limits: {apart_s:.2f} s")
