"""Puts the changes of a log together that belong to one tick. Pure.

BehaviorTree.CPP's logs do not mark the end of a tick. Changes that follow each other closely make a step,
which is recorded as a tick. No result is lost: a step ends before a node that has returned something in it
would return something else.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

__all__ = ["IDLE", "STATUS_WORDS", "Change", "Step", "Steps"]

STATUS_WORDS: Final = ("IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED")
"""The statuses by their numbers, which are the same in BehaviorTree.CPP's logs and in our recordings."""
IDLE: Final = 0
RUNNING: Final = 1
GAP_NS: Final = 1_000_000
LONGEST_NS: Final = 50_000_000
Change = tuple[int, int, int]
"""Time in ns, uid, status."""


class Step(NamedTuple):
    """The changes of one tick: the lasting ones, and results that did not stay."""

    t_ns: int
    duration_ns: int
    changed: list[tuple[int, int]]
    flashed: list[tuple[int, int]]


class Steps:
    """Takes changes in the order of their times."""

    def __init__(self) -> None:
        self._status: dict[int, int] = {}
        self._before: dict[int, int] = {}
        self._results: dict[int, int] = {}
        self._begin_ns = 0
        self._last_ns = 0

    @property
    def statuses(self) -> Mapping[int, int]:
        """The last status of each node."""
        return self._status

    def take(self, t_ns: int, uid: int, status: int) -> Step | None:
        """Takes a change; returns the step that ended before it."""
        ended = self.take_all(((t_ns, uid, status),))
        return ended[0] if ended else None

    def take_all(self, changes: Iterable[Change]) -> list[Step]:
        """Takes changes; returns the steps that ended before one of them."""
        ended: list[Step] = []
        now, before, results = self._status, self._before, self._results
        last_ns = self._last_ns
        for t_ns, uid, status in changes:
            if (
                t_ns - last_ns > GAP_NS
                or t_ns - self._begin_ns > LONGEST_NS
                # A result after a result, or one as before the step, is of another tick.
                or (status != IDLE and uid in results)
                or (status > RUNNING and before.get(uid) == status)
            ):
                self._last_ns = last_ns
                if (step := self.end()) is not None:
                    ended.append(step)
                before, results = self._before, self._results
            if not before:
                self._begin_ns = t_ns
            last_ns = t_ns
            if uid not in before:
                before[uid] = now.get(uid, IDLE)
            now[uid] = status
            if status > RUNNING:
                results[uid] = status
        self._last_ns = last_ns
        return ended

    def end(self) -> Step | None:
        """Ends the open step and returns it; None if nothing happened since the last."""
        if not self._before:
            return None
        now = self._status
        changed = [(uid, now[uid]) for uid, before in self._before.items() if now[uid] != before]
        flashed = [(uid, result) for uid, result in self._results.items() if now[uid] != result]
        step = Step(self._begin_ns, self._last_ns - self._begin_ns, changed, flashed)
        self._before, self._results = {}, {}
        return step
