"""Evaluations: a run beside the same run in lock-step, and the pool with one and two workers."""

from __future__ import annotations

import contextlib
import io
import os
import resource
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from executor.supervision.single_threaded import SINGLE_THREADED

if TYPE_CHECKING:
    from executor.evaluation.outcome import Outcome
    from executor.evaluation.plan import Plan
    from executor.evaluation.pool.worker import Done

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "laser_bump_and_go"
ROUNDS = 7
RUNS = 8
SHORT_S = 0.1


def main() -> None:
    """Prints every figure, each from a process of its own."""
    environment = {**os.environ, **SINGLE_THREADED, "PYTHONPATH": str(ROOT)}
    for part in ("a_run", "the_parent", "the_pool"):
        code = f"from tests.benchmarks.evaluation import {part}; {part}()"
        subprocess.run([sys.executable, "-c", code], env=environment, cwd=ROOT, check=True)


def _plan(duration_s: float | None = None) -> Plan:
    import dataclasses

    from executor.evaluation.plan import make_plan
    from translator import open_path

    plan = make_plan(open_path(EXAMPLE), "room")
    if duration_s is None:
        return plan
    return dataclasses.replace(plan, evaluation=plan.evaluation.model_copy(update={"duration_s": duration_s}))


def a_run() -> None:
    """Compares processor times of one seed: an evaluation's run, and `run --lockstep`, in turn."""
    from executor.evaluation.run import run_cell
    from executor.headless.lockstep import LockstepOptions, run_lockstep

    plan = _plan()
    ratios = []
    for seed in range(ROUNDS):
        with contextlib.redirect_stdout(io.StringIO()):
            began_s = time.process_time()
            run_lockstep(plan.project, LockstepOptions(seed=seed, duration_s=plan.evaluation.duration_s))
            plain_s = time.process_time() - began_s
            began_s = time.process_time()
            run_cell(plan, seed)
            ratios.append((time.process_time() - began_s) / plain_s)
    print(f"a run of an evaluation: {statistics.median(ratios):.2f} × the processor time of run --lockstep")


def the_parent() -> None:
    """Measures what it costs to load the parent, and what a further, very short run adds."""
    began_s = time.process_time()
    from executor.evaluation.evaluate import load_libraries
    from executor.evaluation.pool.supervisor import Supervisor
    from executor.evaluation.run import run_cell

    load_libraries()
    loaded_s = time.process_time() - began_s
    plan, costs = _plan(SHORT_S), list[float]()

    def cell(seed: int) -> Outcome:
        return run_cell(plan, seed)

    def told(done: Done) -> bool:
        costs.append(done.cpu_s)
        return True

    with Supervisor(cell, 1, first_limit_s=60) as supervisor:
        supervisor.run(range(RUNS), told)
    print(f"the parent: {loaded_s:.2f} s of a processor; a further run adds {statistics.median(costs):.2f} s")


def the_pool() -> None:
    """Compares the processor time a run with two workers and with one, in turn."""
    from executor.evaluation.evaluate import evaluate

    plan, spent = _plan(20), dict[int, list[float]]()
    for _ in range(3):
        for workers in (1, 2):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            evaluate(plan, range(RUNS), workers=workers)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            used_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            spent.setdefault(workers, []).append(used_s)
    ratio = statistics.median(spent[2]) / statistics.median(spent[1])
    print(f"the pool: a run with two workers takes {ratio:.2f} × the processor time with one")


if __name__ == "__main__":
    main()
