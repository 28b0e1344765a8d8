"""Messages between the manager and the process of an evaluation."""

from __future__ import annotations

from typing import Any, Final

import msgspec

from executor.child_messages import Log, Message, Stop


class StartEvaluation(Message, tag="start"):
    """Runs seeds; the fields are those of the command `evaluate`. `record_to` is the file of a recording."""

    archive_base64: str
    evaluation: str
    seeds: list[int]
    known: list[tuple[int, str]]
    runs: int = 0
    record_to: str = ""
    sealed: bool = False


class Started(Message, tag="started"):
    """The evaluation was read; the fields are those of the event `evaluation_started`."""

    workers: int
    seed: int
    wanted: int
    sequential: bool
    duration_s: float
    plan: dict[str, Any]
    notes: str = ""


class RunDone(Message, tag="run_done"):
    """A run has ended; the fields are those of the event `evaluation_outcome`."""

    seed: int
    line: str
    cpu_s: float
    done: int
    wanted: int
    rate: float
    low: float
    high: float
    left_s: float


class EvaluationDone(Message, tag="done"):
    """All is run."""

    wanted: int


class Refused(Message, tag="refused"):
    """The evaluation cannot be run; the text has a line for each reason."""

    message: str


ToEvaluation = StartEvaluation | Stop
FromEvaluation = Log | Started | RunDone | EvaluationDone | Refused
decode_to_evaluation: Final = msgspec.msgpack.Decoder(ToEvaluation).decode
decode_from_evaluation: Final = msgspec.msgpack.Decoder(FromEvaluation).decode
