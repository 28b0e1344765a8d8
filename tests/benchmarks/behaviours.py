"""500 behaviour tests of 60 ticks on *bump and go*: in this process, and in one of their own.

Run alone with `python -m tests.benchmarks behaviours`. The target is at most 2 s.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from tests.benchmarks.figures import Figure, show
from translator import open_path
from translator.behaviour_tests import to_job
from tree_gardener.testing.apart import run_apart
from tree_gardener.testing.job import Job, TestFile

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

TESTS, TICKS = 500, 60
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "laser_bump_and_go"


def measure(_: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the times."""
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
    start_s = time.process_time()
    suite = job.suite()
    cases, problems = job.cases(suite)
    assert len(cases) == TESTS, problems
    yield Figure(f"reading {TESTS} tests, processor time", time.process_time() - start_s, "s")
    start_s = time.process_time()
    assert all(suite.run(case).passed for case in cases)
    yield Figure(
        f"running {TESTS} tests of {TICKS} ticks, processor time", time.process_time() - start_s, "s"
    )
    start_s = time.perf_counter()
    assert all(result.passed for result in run_apart(job, cases))
    took_s = time.perf_counter() - start_s
    yield Figure("the same in a process with its start and its limits, by the clock", took_s, "s")


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


if __name__ == "__main__":
    main()
