"""Breakpoints: where a tree stops, and under which conditions."""

import dataclasses
import enum
import functools
import re
from collections.abc import Callable, Sequence
from typing import Final

from tree_gardener.blackboard import EMPTY, Journal
from tree_gardener.debugging.places import Place, nodes_at, place_of
from tree_gardener.debugging.stepper import Event
from tree_gardener.debugging.watches import Watch, Watches
from tree_gardener.debugging.wiring import RESULTS, Wanted
from tree_gardener.descriptions import as_text
from tree_gardener.errors import PortError, ScriptError, describe
from tree_gardener.node import Node
from tree_gardener.script import names_written, parse
from tree_gardener.status import Status

_LONGEST: Final = 200
_KEY: Final = re.compile(r"\{([^{}]+)\}")


class When(enum.Enum):
    """The moments at which a breakpoint can stop the tree."""

    BEFORE = "before"
    AFTER = "after"
    RETURNS = "returns"
    HALTED = "halted"


@dataclasses.dataclass(frozen=True)
class Breakpoint:
    """A breakpoint on a block.

    Attributes:
        place: the block, in all instances of its tree or in one.
        when: before its tick, after it, when it returns `status`, or when it is halted.
        status: the result for RETURNS.
        condition: a script that must be true, in the scope of the node; "" for always.
        hits: the first hit at which it stops, from 1; those before are only counted.
        log: a line to write instead of stopping, in which ``{key}`` is the value of an entry; "" to stop.
        is_on: whether it has any effect.
    """

    place: Place
    when: When = When.BEFORE
    status: Status | None = None
    condition: str = ""
    hits: int = 1
    log: str = ""
    is_on: bool = True

    @property
    def results(self) -> frozenset[Status]:
        """The results after which it is looked at."""
        if self.when is When.AFTER:
            return RESULTS
        return frozenset((self.status,)) if self.when is When.RETURNS and self.status else frozenset()

    @property
    def wanted(self) -> Wanted:
        """The questions that its nodes must ask."""
        return Wanted(self.when is When.BEFORE, self.results, halted=self.when is When.HALTED)

    @property
    def moment(self) -> str:
        """When it stops, in words."""
        if self.when is When.RETURNS and self.status is not None:
            return f"when it returns {self.status.name}"
        return {When.BEFORE: "before its tick", When.AFTER: "after its tick"}.get(
            self.when, "when it is halted"
        )


class BreakpointError(ValueError):
    """A breakpoint cannot be set; the text says why."""


@dataclasses.dataclass(slots=True)
class _Set:
    """A breakpoint at one node."""

    breakpoint: Breakpoint
    condition: Watch | None

    @property
    def wanted(self) -> Wanted:
        """The questions that its node must ask."""
        wanted = self.breakpoint.wanted
        if self.condition is None or not wanted.is_round_tick:
            return wanted
        return wanted._replace(tests=(self.condition,))


class Breakpoints:
    """The breakpoints of a tree.

    Attributes:
        all: the breakpoints, in the order in which they were set.
        are_on: whether they have any effect.
    """

    def __init__(
        self,
        nodes: Sequence[Node],
        say: Callable[[str], None],
        watch_writes: Callable[[Journal | None], None],
    ) -> None:
        self.all: list[Breakpoint] = []
        self.are_on = True
        self._blocks: dict[tuple[str, ...], list[Node]] = {}
        for node in nodes:
            self._blocks.setdefault(place_of(node)[:2], []).append(node)
        self._say = say
        self._watch_writes = watch_writes
        self._at: dict[int, list[_Set]] = {}
        self._hits: dict[Breakpoint, int] = {}

    def set(self, breakpoints: Sequence[Breakpoint]) -> None:
        """Replaces all breakpoints; those that stay keep their count of hits.

        Raises:
            BreakpointError: one cannot be set; all are as they were.
        """
        at: dict[int, list[_Set]] = {}
        watches = Watches()
        for each in breakpoints:
            check(each)
            for node in nodes_at(self._blocks.get(each.place[:2], ()), each.place):
                at.setdefault(node.uid, []).append(_Set(each, _condition(each, node, watches)))
        self.all = list(breakpoints)
        self._at = at
        self._watch_writes(watches.written if watches else None)
        self._hits = {each: self._hits.get(each, 0) for each in breakpoints}

    def hits(self, breakpoint_: Breakpoint) -> int:
        """Returns how often a breakpoint was hit."""
        return self._hits.get(breakpoint_, 0)

    def wanted(self) -> dict[int, Wanted]:
        """Returns what must be asked at which nodes."""
        wanted: dict[int, Wanted] = {}
        if not self.are_on:
            return wanted
        for uid, sets in self._at.items():
            active = [each.wanted for each in sets if each.breakpoint.is_on]
            if active:
                wanted[uid] = functools.reduce(Wanted.joined, active)
        return wanted

    def reason(self, event: Event, node: Node, status: Status | None) -> str:
        """Counts the hits at an event, and writes log lines; returns why the tree stops, or ""."""
        if not self.are_on:
            return ""
        reason = ""
        for each in self._at.get(node.uid, ()):
            if _is_for(each.breakpoint, event, status):
                reason = self._hit(each, node) or reason
        return reason

    def _hit(self, found: _Set, node: Node) -> str:
        each = found.breakpoint
        try:
            if found.condition is not None and not found.condition.is_true():
                return ""
        except (ScriptError, PortError) as error:
            return f"the condition '{each.condition}' of a breakpoint cannot be tested: {error}"
        except Exception as error:  # noqa: BLE001, RUF100 - a class of the user
            return f"the condition '{each.condition}' of a breakpoint cannot be tested: {describe(error)}"
        count = self._hits[each] = self._hits.get(each, 0) + 1
        if count < each.hits:
            return ""
        if each.log:
            self._say(f"{node.path}: {_filled(each.log, node)}")
            return ""
        which = f", hit {count}" if count > 1 else ""
        return f"breakpoint {self.all.index(each) + 1} {each.moment}{which}"


def check(each: Breakpoint) -> None:
    """Checks a breakpoint.

    Raises:
        BreakpointError: it is wrong.
    """
    if each.hits < 1:
        raise BreakpointError(f"the hit count is {each.hits} and must be 1 or more")
    if (each.when is When.RETURNS) != (each.status is not None) or each.status is Status.IDLE:
        raise BreakpointError("a breakpoint on a result needs RUNNING, SUCCESS, FAILURE or SKIPPED")
    if not each.condition:
        return
    try:
        written = names_written(parse(each.condition))
    except ScriptError as error:
        raise BreakpointError(f"in the condition '{each.condition}': {error}") from None
    if written:
        names = ", ".join(sorted({name.name for name in written}))
        raise BreakpointError(f"the condition '{each.condition}' writes {names}; it may only read (use ==)")


def _condition(each: Breakpoint, node: Node, watches: Watches) -> Watch | None:
    return watches.at(node, each.condition) if each.condition else None


def _is_for(each: Breakpoint, event: Event, status: Status | None) -> bool:
    if not each.is_on:
        return False
    if event is Event.BEFORE:
        return each.when is When.BEFORE
    if event is Event.HALTED:
        return each.when is When.HALTED
    return status in each.results


def _filled(text: str, node: Node) -> str:
    def value(found: "re.Match[str]") -> str:
        entry = node.board.find(found[1].strip())
        return found[0] if entry is None or entry.value is EMPTY else as_text(entry.value, _LONGEST)

    return _KEY.sub(value, text)
