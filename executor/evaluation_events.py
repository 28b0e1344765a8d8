"""The command and the events of an evaluation: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

JobName = Annotated[str, Meta(pattern=r"^[0-9a-f]{1,32}$")]
Seed = Annotated[int, Meta(ge=0, le=(1 << 63) - 1)]
EvaluationEnd = Literal["complete", "refused", "failed", "replaced"]


class Evaluate(Struct, forbid_unknown_fields=True):
    """Runs seeds of an evaluation of a project, beside the ladder.

    A job that already runs continues, and its outcomes so far are sent again; another job ends it.

    Attributes:
        job: a name of the job, chosen by the client.
        app_zip_base64: the files of the project.
        evaluation: the name of the evaluation.
        seeds: the seeds to run; without any, those that the evaluation says.
        runs: how many, if not as the evaluation says; 0 is as it says.
        known: [seed, outcome] of seeds that are part of the evaluation and need not be run.
        record: whether the first of the seeds alone is run, and recorded.
        sealed: whether tree and actions run in a process that sees nothing of the judge.
    """

    job: JobName
    app_zip_base64: str
    evaluation: Annotated[str, Meta(min_length=1, max_length=100)]
    seeds: Annotated[list[Seed], Meta(max_length=100_000)] = []
    known: Annotated[list[tuple[Seed, str]], Meta(max_length=100_000)] = []
    runs: Annotated[int, Meta(ge=0, le=100_000)] = 0
    record: bool = False
    sealed: bool = False


class EvaluationStarted(Struct):
    """The evaluation was read and checked, and its first run begins.

    `seed` is the first, and `wanted` the largest number of runs. `plan` has outlines of the world for its
    report, in m. `duration_s` is how long a run takes at most, in simulated s. `notes` has a line for each
    part of the project that does not run, such as a launch node.
    """

    job: str
    workers: int
    seed: int
    wanted: int
    sequential: bool
    duration_s: float
    plan: dict[str, Any]
    notes: str = ""


class EvaluationOutcome(Struct):
    """The outcome of one run.

    Attributes:
        line: the line of `runs.jsonl`.
        cpu_s: its processor time in s.
        rate, low, high: of all outcomes so far, with the 95 % interval.
        left_s: the real time that is probably left, in s.
    """

    job: str
    seed: int
    line: str
    cpu_s: float
    done: int
    wanted: int
    rate: float
    low: float
    high: float
    left_s: float


class EvaluationEnded(Struct):
    """A job has ended.

    Attributes:
        wanted: how many of the seeds belong to the evaluation; with `until` these may be fewer than asked.
        message: why it was refused or failed, a line for each problem.
        run: the name of the recording; "" without one.
    """

    job: str
    end: EvaluationEnd
    wanted: int = 0
    message: str = ""
    run: str = ""
