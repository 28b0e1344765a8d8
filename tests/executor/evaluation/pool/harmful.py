"""Runs seeds that harm themselves with the pool, in a process of its own, and prints the outcomes.

Arguments: the number of workers, and whether a worker is killed after the third run.
"""

import os
import signal
import sys
from pathlib import Path

from executor.evaluation.outcome import Outcome
from executor.evaluation.pool.supervisor import Supervisor
from executor.evaluation.pool.worker import Done
from executor.supervision.descendants import descendants
from tests.budget import count

SEEDS = count("evaluation_pool_runs")


def cell(seed: int) -> Outcome:  # noqa: C901, PLR0912 - one case a harm
    match seed:
        case 2:
            os.kill(os.getpid(), signal.SIGSEGV)
        case 3:
            exec(compile("while True: pass", "actions/Hang.py", "exec"))  # noqa: S102 - what a user's action is
        case 4:
            if os.fork() == 0 and os.fork() == 0:
                os.setsid()
                signal.pause()
        case 5:
            bytearray(1 << 31)
        case 6:
            os._exit(0)
        case 7:
            raise ValueError("no way")
        case 8:
            if Path(sys.argv[3]).exists():  # only the first try kills its worker
                Path(sys.argv[3]).unlink()
                os.kill(os.getppid(), signal.SIGKILL)
                signal.pause()
        case 9:
            os.kill(os.getppid(), signal.SIGKILL)
            signal.pause()
        case 10:
            sys.stdout.write("noise" * 100_000)
            sys.stderr.write("noise" * 100_000)
        case 11:
            exec(compile("import ctypes\nctypes.string_at(0)", "actions/Crash.py", "exec"))  # noqa: S102
        case _:
            pass
    return Outcome(seed, "success", "x" * 100_000 if seed == 12 else "")


def main() -> None:
    workers, kills = int(sys.argv[1]), sys.argv[2] == "kill"
    found: dict[int, Outcome] = {}

    def told(done: Done) -> bool:
        found[done.outcome.seed] = done.outcome
        if kills and len(found) == 3:
            os.kill(supervisor.pids[0], signal.SIGKILL)
        return True

    with Supervisor(cell, workers, first_limit_s=5, least_limit_s=3.0, memory_bytes=1 << 30) as supervisor:
        supervisor.run(range(SEEDS), told)
    for seed in sorted(found):
        print(found[seed].to_line())  # noqa: T201 - the result
    print(len(descendants(os.getpid())))  # noqa: T201


main()
