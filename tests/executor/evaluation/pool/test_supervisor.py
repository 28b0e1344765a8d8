"""The pool: whatever a run does to itself is its own outcome, with any number of workers."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from executor.evaluation.outcome import Outcome, read_outcome
from executor.evaluation.pool.supervisor import threads_of_this_process
from executor.supervision.scratch import LOCK, remove_abandoned
from tests.budget import count

ROOT = Path(__file__).parents[4]
RUNS = count("evaluation_pool_runs")
pytestmark = pytest.mark.timeout(300)


def pool(tmp_path, workers, how="calm"):
    once = tmp_path / "once"
    once.write_text("")
    folder = tmp_path / "temporary"
    folder.mkdir(exist_ok=True)
    done = subprocess.run(
        [sys.executable, "-m", "tests.executor.evaluation.pool.harmful", str(workers), how, str(once)],
        cwd=ROOT,
        env=os.environ | {"TMPDIR": str(folder)},
        capture_output=True,
        text=True,
        check=True,
        timeout=250,
    )
    *lines, left = done.stdout.splitlines()
    assert left == "0", "processes are left behind"
    for lock in folder.glob(f"*/{LOCK}"):
        os.utime(lock, (0, 0))
    remove_abandoned(folder)
    assert list(folder.iterdir()) == [], "the next start does not remove what killed workers left"
    return lines


def test_what_runs_do_to_themselves_is_their_outcome_and_workers_change_nothing(tmp_path):
    one = pool(tmp_path, 1)
    found = {outcome.seed: outcome for outcome in map(read_outcome, one)}
    assert sorted(found) == list(range(RUNS))
    told = {seed: (outcome.outcome, outcome.why[:80]) for seed, outcome in found.items()}
    assert told[2][1].startswith("the process of the run ended with SIGSEGV")
    assert told[3] == ("timeout", "the run took more than its limit of processor time in actions/Hang.py")
    assert told[4] == ("success", "")
    assert told[5] == ("error", "MemoryError")
    assert told[6] == ("crashed", "the process of the run ended by itself with status 0")
    assert told[7] == ("error", "ValueError: no way")
    assert told[8] == ("success", "")
    assert told[9] == ("lost", "its worker was lost 3 times")
    assert told[10] == ("success", "")
    assert told[11] == ("crashed", "the process of the run ended with SIGSEGV in actions/Crash.py:2")
    assert found[12] == Outcome(12, "success", "x" * 100_000)
    assert {found[seed].outcome for seed in range(13, RUNS)} == {"success"}
    assert pool(tmp_path, 2) == one
    assert pool(tmp_path, 2, "kill") == one


def test_threads_are_counted():
    assert threads_of_this_process() >= 1
