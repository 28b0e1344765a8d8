"""Reads an executor's messages about an evaluation. They are not trusted, but decoded with bounds. Pure.

PostgreSQL stores no NUL, neither in text nor in JSON: none passes.
"""

from __future__ import annotations

import re
from typing import Annotated, Any, Final, Literal, TypeVar

import msgspec
from msgspec import Meta

from backend.evaluations.choices import Result  # noqa: TC001 - msgspec reads the annotations

_TEXTS: Final = re.compile(rb'"(?:[^"\\]|\\.)*+"')
_BRACKETS: Final = re.compile(rb"[\[\]{}]")
_Kind = TypeVar("_Kind", bound=msgspec.Struct)
MOST_LINE: Final = 64 << 10
MOST_PLAN: Final = 1 << 20
MOST_DEPTH: Final = 32
"""An outcome is answered as JSON, whose writers call themselves for each level."""
_Count = Annotated[int, Meta(ge=0, le=100_000)]
_Number = Annotated[float, Meta(ge=-1e12, le=1e12)]
_Share = Annotated[float, Meta(ge=0, le=1)]
_Seed = Annotated[int, Meta(ge=0, le=(1 << 63) - 1)]
_Measure = Annotated[str, Meta(max_length=200, pattern=r"^[^\x00]*$")]


class Begun(msgspec.Struct):
    """The event `evaluation_started`."""

    job: str
    workers: Annotated[int, Meta(ge=1, le=1024)]
    seed: _Seed
    wanted: _Count
    sequential: bool
    duration_s: Annotated[float, Meta(ge=0, le=1e6)]
    plan: dict[str, Any]
    notes: Annotated[str, Meta(max_length=100_000)] = ""

    def __post_init__(self) -> None:
        self.notes = self.notes.replace("\0", "")
        encoded = msgspec.json.encode(self.plan)
        if len(encoded) > MOST_PLAN or rb"\u0000" in encoded or depth_of(encoded) > MOST_DEPTH:
            self.plan = {}


class Done(msgspec.Struct):
    """The event `evaluation_outcome`."""

    job: str
    seed: _Seed
    line: Annotated[str, Meta(max_length=MOST_LINE)]
    cpu_s: Annotated[float, Meta(ge=0, le=1e6)]
    done: _Count
    wanted: _Count
    rate: _Share
    low: _Share
    high: _Share
    left_s: Annotated[float, Meta(ge=0, le=1e9)]


class Ended(msgspec.Struct):
    """The event `evaluation_ended`."""

    job: str
    end: Literal["complete", "refused", "failed", "replaced"]
    wanted: _Count = 0
    message: Annotated[str, Meta(max_length=100_000)] = ""
    run: Annotated[str, Meta(pattern=r"^[0-9a-f]{0,32}$")] = ""

    def __post_init__(self) -> None:
        self.message = self.message.replace("\0", "")


class Refusal(msgspec.Struct):
    """The event `error`."""

    code: str = ""
    message: str = ""

    def __post_init__(self) -> None:
        self.message = self.message.replace("\0", "")


class Item(msgspec.Struct):
    """An item of the judge in an outcome."""

    item: str
    holds: bool
    margin: _Number | None = None
    unit: Annotated[str, Meta(max_length=10, pattern=r"^[^\x00]*$")] = ""


class Line(msgspec.Struct):
    """A line of `runs.jsonl`, as far as the server reads it."""

    seed: _Seed
    outcome: Result
    why: str = ""
    end_s: Annotated[float, Meta(ge=0, le=1e6)] = 0.0
    items: Annotated[list[Item], Meta(max_length=1000)] = []
    measures: Annotated[dict[_Measure, _Number], Meta(max_length=200)] = {}

    def __post_init__(self) -> None:
        self.why = self.why.replace("\0", "")

    @property
    def nearest(self) -> Item | None:
        """The item that decided by least: of those that fail, or of all if none fails."""
        failed = [item for item in self.items if not item.holds]
        with_margin = [item for item in failed or self.items if item.margin is not None]
        return min(with_margin, key=lambda item: item.margin or 0.0, default=None)


class _Envelope(msgspec.Struct):
    id: str
    command: str
    data: msgspec.Raw = msgspec.Raw(b"null")


_KINDS: Final[dict[str, type[msgspec.Struct]]] = {
    "evaluation_started": Begun,
    "evaluation_outcome": Done,
    "evaluation_ended": Ended,
    "error": Refusal,
}


def read(message: str | bytes) -> msgspec.Struct | None:
    """Returns what a message says of an evaluation; None if it is about something else.

    Raises:
        ValueError: it cannot be what it should be.
    """
    envelope = _decode(message, _Envelope)
    kind = _KINDS.get(envelope.command)
    if kind is None or (kind is Refusal and envelope.id == ""):
        return None
    return _decode(envelope.data, kind)


def read_line(done: Done) -> Line:
    """Returns the outcome of a run.

    Raises:
        ValueError: it is no outcome, nested too deeply, or of another seed.
    """
    line = _decode(done.line, Line)
    if depth_of(done.line.encode()) > MOST_DEPTH:
        raise ValueError("it is nested too deeply")
    if line.seed != done.seed or "\n" in done.line:
        raise ValueError("the line is of another seed")
    return line


def depth_of(document: bytes) -> int:
    """Returns how deeply lists and objects are nested in valid JSON."""
    depth = most = 0
    for mark in _BRACKETS.findall(_TEXTS.sub(b"", document)):
        depth += 1 if mark in b"[{" else -1
        most = max(most, depth)
    return most


def _decode(data: str | bytes | msgspec.Raw, kind: type[_Kind]) -> _Kind:
    try:
        return msgspec.json.decode(data, type=kind)
    except RecursionError as error:
        raise ValueError("it is nested too deeply") from error
