"""Finds what has changed in another program's tree between two looks at it. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor import child_messages
from executor.application.preview import preview
from executor.messages import BlackboardEntry
from executor.recorder.values import value_json
from tree_gardener.status import IDLE, Status

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.debug_messages import ResultName
    from executor.messages import NodeStatus
    from executor.recorder.outside.tree_log import EntryRow
    from tree_gardener.groot.remote import NodeState

__all__ = ["Boards", "Statuses", "type_name"]

_NAMES: Final[dict[Status, NodeStatus]] = {
    Status.IDLE: "IDLE",
    Status.RUNNING: "RUNNING",
    Status.SUCCESS: "SUCCESS",
    Status.FAILURE: "FAILURE",
    Status.SKIPPED: "SKIPPED",
}
_RESULTS: Final[dict[Status, ResultName]] = {
    Status.RUNNING: "RUNNING",
    Status.SUCCESS: "SUCCESS",
    Status.FAILURE: "FAILURE",
    Status.SKIPPED: "SKIPPED",
}
_TYPES: Final[dict[type, str]] = {bool: "bool", int: "int", float: "double", str: "string"}
Board = dict[str, Any]


class Statuses:
    """The statuses of the nodes, of which each look makes a tick.

    Args:
        numbers: our uid of each node by its uid there; states of others are dropped and counted.
    """

    def __init__(self, numbers: Mapping[int, int]) -> None:
        self._seen: dict[int, NodeState] = {}
        self._past: dict[int, NodeStatus] = {}
        self._numbers = numbers
        self._looks = 0
        self.dropped = 0

    @property
    def looks(self) -> int:
        """The number of looks."""
        return self._looks

    def awake(self) -> list[tuple[int, ResultName]]:
        """Returns the nodes that are not IDLE, with their statuses."""
        return [
            (self._numbers[uid], _RESULTS[state.status])
            for uid, state in self._seen.items()
            if state.status is not IDLE
        ]

    def take(self, states: Mapping[int, NodeState], t_s: float) -> child_messages.Tick:
        """Returns the changes since the last look, as those of a tick."""
        seen, past = self._seen, self._past
        self._looks += 1
        changed: list[tuple[int, NodeStatus]] = []
        flashed: list[tuple[int, NodeStatus]] = []
        # Most states are those of the last look, and then the same objects.
        for key, state in [each for each in states.items() if seen.get(each[0]) is not each[1]]:
            uid = self._numbers.get(key)
            if uid is None:
                self.dropped += 1
                continue
            before = seen.get(key)
            seen[key] = state
            if state == before:
                continue
            if state.status is not (before.status if before is not None else IDLE):
                changed.append((uid, _NAMES[state.status]))
            past.pop(uid, None)
            if state.status is IDLE and state.was is not IDLE:
                past[uid] = _NAMES[state.was]
                if before is not None:
                    flashed.append((uid, _NAMES[state.was]))
        return child_messages.Tick(
            n=self._looks, changed=changed, flashed=flashed, duration_ms=0.0, past=sorted(past.items()), t=t_s
        )


class Boards:
    """The blackboards as they were last seen."""

    def __init__(self) -> None:
        self._boards: dict[str, Board] = {}

    def take(self, boards: Mapping[str, Board], main: str) -> tuple[list[BlackboardEntry], list[EntryRow]]:
        """Returns the entries that changed, as they are shown and as they are recorded.

        Args:
            boards: all blackboards by name.
            main: the name of that of the main tree, which has the scope "".
        """
        shown: list[BlackboardEntry] = []
        rows: list[EntryRow] = []
        for name in {**self._boards, **boards}:
            scope = "" if name == main else name
            before, now = self._boards.get(name, {}), boards.get(name, {})
            for key, value in now.items():
                if key in before and type(before[key]) is type(value) and before[key] == value:
                    continue
                short, is_preview = preview(value)
                kind = type_name(value)
                shown.append(BlackboardEntry(scope, key, kind, short, is_preview))
                rows.append((scope, key, kind, value_json(value, _describe), False))
            for key in before.keys() - now.keys():
                kind = type_name(before[key])
                shown.append(BlackboardEntry(scope, key, kind, None, removed=True))
                rows.append((scope, key, kind, "null", True))
        self._boards = {name: dict(board) for name, board in boards.items()}
        return shown, rows


def type_name(value: object) -> str:
    """Returns the name of a value's type, as far as the protocol tells it."""
    return _TYPES.get(type(value), "any")


def _describe(value: Any) -> str:
    return str(preview(value)[0])
