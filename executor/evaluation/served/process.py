"""The process of an evaluation in a session: `python -m executor.evaluation.served.process --channel-fd N`.

It gets one job, runs its seeds with the pool of this machine, and sends each outcome to the manager. It has
one thread, since it forks its runs: it writes to its channel itself, and its forks close that.

With `--cluster ADDRESS` a Ray cluster runs the seeds; the recording of a run is made here all the same.
"""

from __future__ import annotations

import argparse
import base64
import binascii
import dataclasses
import os
import socket
import struct
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.evaluation_messages import (
    EvaluationDone,
    FromEvaluation,
    Refused,
    RunDone,
    Started,
    StartEvaluation,
    decode_to_evaluation,
)
from executor.supervision.channel import encode
from executor.supervision.confine import die_with_parent
from executor.supervision.room import processors

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from executor.evaluation.evaluate import Progress
    from executor.evaluation.outcome import Outcome
    from executor.evaluation.plan import Plan
    from executor.evaluation.pool.worker import Done

__all__ = ["main", "run_job", "shortened"]

NICE: Final = 5
"""Interactive sessions of the same machine go first."""
MOST_PROBLEMS: Final = 50
MOST_LINE_BYTES: Final = 64 << 10
_PREFIX: Final = struct.Struct("<I")


class _RefusedError(Exception):
    """The evaluation cannot be run; the text has a line for each reason."""


def run_job(job: StartEvaluation, say: Callable[[FromEvaluation], None], cluster: str = "") -> None:
    """Runs a job, and says what becomes of it.

    Args:
        job: the job.
        say: called with each message to the manager.
        cluster: the address of a Ray cluster that runs the seeds; "" is this machine.
    """
    try:
        plan, notes = _plan(job)
        workers = 1 if job.record_to else _workers(cluster)
    except _RefusedError as refused:
        say(Refused(str(refused)))
        return
    from executor.evaluation.report import plan_of  # noqa: PLC0415 - after the environment is set

    evaluation = plan.evaluation
    say(
        Started(
            workers=workers,
            seed=evaluation.seed,
            wanted=evaluation.most_runs,
            sequential=evaluation.until is not None,
            duration_s=evaluation.duration_s,
            plan=plan_of(plan.universe),
            notes=notes,
        )
    )
    try:
        say(_recorded(job, plan, say) if job.record_to else _evaluated(job, plan, say, cluster, workers))
    except _RefusedError as refused:
        say(Refused(str(refused)))


def _workers(cluster: str) -> int:
    """Returns how many runs take place at a time.

    Raises:
        _RefusedError: there is no such cluster.
    """
    if not cluster:
        return processors()
    from executor.evaluation.cluster.ray_pool import ClusterError, processors_of  # noqa: PLC0415 - rarely used

    try:
        return processors_of(cluster)
    except ClusterError as error:
        raise _RefusedError(str(error)) from error


def _evaluated(
    job: StartEvaluation, plan: Plan, say: Callable[[FromEvaluation], None], cluster: str, workers: int
) -> EvaluationDone:
    from executor.evaluation.cluster.ray_pool import ClusterError  # noqa: PLC0415 - as above
    from executor.evaluation.evaluate import ThreadsError, evaluate  # noqa: PLC0415 - as above
    from executor.evaluation.outcome import Outcome  # noqa: PLC0415 - as above

    known = [Outcome(seed, outcome) for seed, outcome in job.known]
    sequential = plan.evaluation.until is not None

    def told(progress: Progress, done: Done | None) -> None:
        if done is not None:
            say(_run_done(done, progress, sequential=sequential))

    first = plan.evaluation.seed
    wanted = job.seeds or range(first, first + plan.evaluation.most_runs)
    seeds = sorted({*wanted, *(seed for seed, _ in job.known)})
    try:
        progress = evaluate(plan, seeds, workers=workers, cluster=cluster or None, kept=known, told=told)
    except ClusterError as error:
        raise _RefusedError(str(error)) from error
    except ThreadsError as error:
        raise SystemExit(f"{error}") from error
    return EvaluationDone(progress.wanted)


def _recorded(job: StartEvaluation, plan: Plan, say: Callable[[FromEvaluation], None]) -> EvaluationDone:
    """Runs the first seed alone, into a recording."""
    from executor.evaluation.evaluate import FIRST_LIMIT_S, Progress, load_libraries  # noqa: PLC0415 - as above
    from executor.evaluation.pool.supervisor import Supervisor  # noqa: PLC0415 - as above
    from executor.evaluation.run import run_cell  # noqa: PLC0415 - as above

    load_libraries()
    file = Path(job.record_to)
    file.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    progress = Progress(1, 1)

    def hear(done: Done) -> bool:
        progress.outcomes[done.outcome.seed] = done.outcome
        say(_run_done(done, progress, sequential=False))
        return True

    limit_s = 2 * max(FIRST_LIMIT_S, 2 * plan.evaluation.duration_s)  # to record takes time, too
    with Supervisor(
        lambda seed: run_cell(plan, seed, recording=file), 1, first_limit_s=limit_s
    ) as supervisor:
        supervisor.run(job.seeds[:1], hear)
    return EvaluationDone(1)


def _run_done(done: Done, progress: Progress, *, sequential: bool) -> RunDone:
    from executor.evaluation.summary import interval_of  # noqa: PLC0415 - as above

    counted = [outcome for outcome in progress.outcomes.values() if outcome.is_counted]
    successes = sum(outcome.is_success for outcome in counted)
    low, high = interval_of(successes, len(counted), sequential=sequential)
    return RunDone(
        seed=done.outcome.seed,
        line=shortened(done.outcome),
        cpu_s=done.cpu_s,
        done=len(progress.outcomes),
        wanted=progress.wanted,
        rate=successes / len(counted) if counted else 0.0,
        low=low,
        high=high,
        left_s=progress.left_s,
    )


def shortened(outcome: Outcome) -> str:
    """Returns the line of an outcome; one that is too long loses what the user's code may make long."""
    line = outcome.to_line()
    if len(line.encode()) <= MOST_LINE_BYTES:
        return line
    short = dataclasses.replace(outcome, why=outcome.why[:1000], drawn={}, seen={}, bumps=[], faults=[])
    line = short.to_line()
    if len(line.encode()) <= MOST_LINE_BYTES:
        return line
    return dataclasses.replace(short, items=[], measures={}, path=[]).to_line()


def _plan(job: StartEvaluation) -> tuple[Plan, str]:
    """Reads the project and its evaluation; also returns a line for each launch node that is left out.

    Raises:
        _RefusedError: it cannot be run.
    """
    from executor.evaluation.plan import EvaluationError, make_plan, sealed  # noqa: PLC0415 - as above
    from executor.evaluation.sealed.confine import SealError  # noqa: PLC0415 - as above
    from executor.headless.left_out import left_out  # noqa: PLC0415 - as above
    from executor.universes.document import DocumentError  # noqa: PLC0415 - as above
    from translator import TranslatorError, load  # noqa: PLC0415 - as above
    from translator.archive import read_zip  # noqa: PLC0415 - as above

    try:
        files = read_zip(base64.b64decode(job.archive_base64, validate=True))
        plan = make_plan(load(files), job.evaluation)
        notes = "\n".join(left_out(files))
        plan = sealed(plan) if job.sealed else plan
    except binascii.Error as error:
        raise _RefusedError(f"the project is no base64: {error}") from error
    except TranslatorError as error:
        lines = [str(each) for each in error.diagnostics]
        raise _RefusedError("\n".join(lines[:MOST_PROBLEMS])) from error
    except (DocumentError, EvaluationError, SealError) as error:
        raise _RefusedError("\n".join(str(error).splitlines()[:MOST_PROBLEMS])) from error
    evaluation = plan.evaluation
    if runs := job.runs or len(job.seeds):
        evaluation = evaluation.model_copy(update={"until": None, "runs": runs})
    return dataclasses.replace(plan, evaluation=evaluation), notes


def _receive(channel: socket.socket) -> StartEvaluation | None:
    """Waits for the job; None if the manager ends the process before."""
    with channel.makefile("rb") as stream:
        prefix = stream.read(_PREFIX.size)
        if len(prefix) < _PREFIX.size:
            return None
        (length,) = _PREFIX.unpack(prefix)
        message = decode_to_evaluation(stream.read(length))
    return message if isinstance(message, StartEvaluation) else None


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the process; returns its exit status."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--channel-fd", type=int, required=True)
    parser.add_argument("--cluster", default="")
    options = parser.parse_args(arguments)
    die_with_parent()
    os.nice(NICE)
    with socket.socket(fileno=options.channel_fd) as channel:
        channel.settimeout(None)
        job = _receive(channel)
        if job is None:
            return 0
        # A run has no way to the manager; what it says, its worker reads.
        os.register_at_fork(after_in_child=channel.close)
        run_job(job, lambda message: channel.sendall(encode(message)), options.cluster)
    return 0


if __name__ == "__main__":
    from executor.ros.environment import use_lockstep_environment

    use_lockstep_environment()
    sys.exit(main())
