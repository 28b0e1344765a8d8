"""Puts the changes of a log together that belong to one tick. Pure.

BehaviorTree.CPP's logs do not mark the end of a tick. Changes that follow each other closely make a step,
which is recorded as a tick. No result is lost: a step ends before a node that has returned something in it
would return something else.
"""

from __future__ import annotations

from typing import Final, NamedTuple

__all__ = ["IDLE", "STATUS_WORDS", "Step", "Steps"]

STATUS_WORDS: Final = ("IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED")
"""The statuses by their numbers, which are the same in BehaviorTree.CPP's logs and in our recordings."""
IDLE: Final = 0
RUNNING: Final = 1
GAP_NS: Final = 1_000_000
LONGEST_NS: Final = 50_000_000


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

    def take(self, t_ns: int, uid: int, status: int) -> Step | None:
        """Takes a change; returns the step that ended before it."""
        is_apart = t_ns - self._last_ns > GAP_NS or t_ns - self._begin_ns > LONGEST_NS
        is_result = status not in {IDLE, RUNNING}
        is_again = status != IDLE and uid in self._results
        is_as_before = is_result and self._before.get(uid) == status
        ended = self.end() if is_apart or is_again or is_as_before else None
        if not self._before:
            self._begin_ns = t_ns
        self._last_ns = t_ns
        self._before.setdefault(uid, self._status.get(uid, IDLE))
        self._status[uid] = status
        if is_result:
            self._results[uid] = status
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
