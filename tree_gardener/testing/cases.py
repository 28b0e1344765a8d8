"""Behaviour tests and their results, as data."""

import dataclasses
from collections.abc import Mapping
from typing import Any, Final

from tree_gardener.status import Status

MAX_TICKS: Final = 100_000
REAL: Final = "real"


@dataclasses.dataclass(frozen=True)
class Step:
    """A result of a double for `times` ticks, with the values that it writes at each of them.

    With `at`, it is the result from this tick of the test on, however often the leaf was ticked before.
    Several steps of one tick follow each other within it, and the last of them stays.
    """

    status: Status
    outputs: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    times: int = 1
    at: int | None = None


@dataclasses.dataclass(frozen=True)
class Double:
    """The results that replace the leaves found by a pattern.

    Attributes:
        pattern: path, name or type, or a pattern with ``*`` and ``?``.
        steps: results, one a tick; the last one stays.
        for_s: if given, the first step lasts for these seconds after each start, and then the second one.
        real: whether the leaf's own Python runs.
        line: the line in the file.
    """

    pattern: str
    steps: tuple[Step, ...] = ()
    for_s: float | None = None
    real: bool = False
    line: int = 0


@dataclasses.dataclass(frozen=True)
class Claim:
    """Something about the tree after a tick; all that is given must hold.

    Attributes:
        node: path, name, type or id of the node that `status` and `result` are about.
        status: the stored status of the node after the tick.
        result: what the node returned in the tick.
        root: what the root returned in the tick.
        blackboard: values of entries; None for an entry without a value.
        halted: nodes that were halted while RUNNING, up to this tick.
        ticked: how often nodes were ticked, up to this tick.
        during: the claim counts only at ticks at which this one holds too.
    """

    node: str = ""
    status: Status | None = None
    result: Status | None = None
    root: Status | None = None
    blackboard: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    halted: tuple[str, ...] = ()
    ticked: Mapping[str, int] = dataclasses.field(default_factory=dict)
    during: "Claim | None" = None

    @property
    def nodes(self) -> tuple[str, ...]:
        """All nodes that the claim names."""
        own = (self.node,) if self.node else ()
        inner = self.during.nodes if self.during is not None else ()
        return (*own, *self.halted, *self.ticked, *inner)


@dataclasses.dataclass(frozen=True)
class Expectation:
    """A claim, and when it must hold.

    Attributes:
        kind: ``at``, ``eventually`` or ``never``.
        first: for ``at`` the first tick; None for the end of the run.
        last: for ``at`` the last tick; None for the end of the run.
        within_s: for ``eventually`` the time within which it must hold; None for the whole run.
        line: the line in the file.
    """

    kind: str
    claim: Claim
    first: int | None = None
    last: int | None = None
    within_s: float | None = None
    line: int = 0


@dataclasses.dataclass(frozen=True)
class Case:
    """One behaviour test."""

    name: str
    tree: str
    ticks: int
    tick_hz: float
    doubles: tuple[Double, ...]
    expect: tuple[Expectation, ...]
    blackboard: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    repeat: bool = False
    file: str = ""
    line: int = 0

    @property
    def uses_real(self) -> bool:
        """Whether Python of the project runs in it."""
        return any(double.real for double in self.doubles)


@dataclasses.dataclass(frozen=True)
class Failure:
    """Why a test failed.

    Attributes:
        message: one sentence.
        line: the line of the expectation in the file; that of the test if there is none.
        tick: the tick, from 1; 0 before the first one.
        time_s: its time.
        node: path of the node; "" if it is about no single node.
        tree: the tree to which the node belongs, and `node_id` its id in the diagram.
        wanted: the expected value.
        got: the actual value.
        path: the nodes from the root to the node, each with its status after the tick.
    """

    message: str
    line: int = 0
    tick: int = 0
    time_s: float = 0.0
    node: str = ""
    tree: str = ""
    node_id: str = ""
    wanted: str = ""
    got: str = ""
    path: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        when = f"tick {self.tick} ({self.time_s:g} s): " if self.tick else ""
        place = f" [{self.tree} {self.node_id}]" if self.node_id else ""
        about = f"'{self.node}'{place}: " if self.node else ""
        return f"{when}{about}{self.message}"


@dataclasses.dataclass(frozen=True)
class Result:
    """The outcome of one test.

    Attributes:
        ticks: the number of ticks that were done.
        root: what the root returned last; "" without a tick.
        duration_s: how long it took.
        seen: the items that it reached, by tree and node.
    """

    name: str
    file: str
    line: int
    tree: str
    failures: tuple[Failure, ...] = ()
    ticks: int = 0
    root: str = ""
    duration_s: float = 0.0
    seen: Mapping[str, Mapping[str, tuple[str, ...]]] = dataclasses.field(default_factory=dict)

    @property
    def passed(self) -> bool:
        """Whether nothing failed."""
        return not self.failures

    def to_json(self) -> dict[str, Any]:
        """Returns the fields as a JSON object."""
        return {**dataclasses.asdict(self), "passed": self.passed}

    @classmethod
    def from_json(cls, document: Mapping[str, Any]) -> "Result":
        """Reads the form that `to_json` writes."""
        values = {key: value for key, value in document.items() if key != "passed"}
        failures = tuple(
            Failure(**{**failure, "path": tuple((name, status) for name, status in failure["path"])})
            for failure in values.pop("failures")
        )
        return cls(**values, failures=failures)
