"""The statuses and entries of a tree that runs in another program, as a recording has them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.recorder.outside.tree_log import TreeLog
from executor.recorder.outside.tree_xml import LoggedTree
from executor.recorder.tree_recorder import STATUS_CODES
from tree_gardener.groot.remote import LAST_STATUS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from executor.messages import TreeNode
    from executor.recorder.outside.steps import Change
    from executor.recorder.outside.tree_log import EntryRow, TreeWriter
    from tree_gardener.groot.remote import Transition
    from tree_gardener.status import Status

__all__ = ["FollowedTree"]

NAME: Final = "the other program"
_COLUMNS: Final = ("uid", "parent", "type", "kind", "name", "path", "node_id", "tree_id")


class FollowedTree:
    """The last statuses and entries of another program's tree, and their changes in a recording.

    Times of the session are in s. Nothing is written before `restate`.

    Args:
        nodes: the nodes of the tree.
        numbers: our uid of each node, by its uid in the other program.
        xml: the tree, for the recording; nothing if it has its diagrams.
        generation: the number of trees that the recording has.
        told_ns: the time up to which the recording is complete.

    Attributes:
        generation: the number of the last tree in the recording.
        told_ns: the time up to which it is complete.
    """

    def __init__(
        self,
        nodes: Sequence[TreeNode],
        numbers: dict[int, int],
        xml: bytes = b"",
        generation: int = 0,
        told_ns: int = 0,
    ) -> None:
        fields = {name: [getattr(node, name) for node in nodes] for name in _COLUMNS}
        self._tree = LoggedTree(fields | {"ports_json": ["{}"] * len(nodes)}, numbers, xml)
        self._first: dict[int, int] = {}  # the statuses by our uids, until a log has them
        self._entries: dict[tuple[str, str], EntryRow] = {}
        self._log: TreeLog | None = None
        self.generation = generation
        self.told_ns = told_ns

    def restate(self, writer: TreeWriter) -> None:
        """Writes all that is known, and from now on each change."""
        known = dict(self._statuses)
        self._log = log = TreeLog(writer, NAME, self.generation)
        self.generation += 1
        log.tree(self.told_ns, self._tree)
        log.changes((self.told_ns, uid, code) for uid, code in known.items() if code)
        log.entries(self.told_ns, list(self._entries.values()))

    @property
    def _statuses(self) -> Mapping[int, int]:
        """The last statuses by our uids."""
        return self._first if self._log is None else self._log.statuses

    def take(self, transitions: Iterable[Transition], begun_s: float, until_s: float) -> None:
        """Takes the transitions up to now.

        Args:
            transitions: in the order of their times, which count from `begun_s`.
            begun_s: when the other program began to keep them.
            until_s: the present; none is later.
        """
        until_ns = _ns(until_s)
        changes = self._changes(transitions, _ns(begun_s), until_ns)
        if self._log is not None:
            self._log.changes(changes)
        else:
            self._first.update({uid: code for _, uid, code in changes})
        self.told_ns = until_ns

    def _changes(self, transitions: Iterable[Transition], begun_ns: int, until_ns: int) -> Iterator[Change]:
        """Yields the changes of nodes that are known."""
        # Up to 1,000 come at once, 20 times a second: so the loop makes nothing else for each.
        told_ns, uid_of = self.told_ns, self._tree.numbers.get
        for low, high, number, code in transitions:
            uid = uid_of(number)
            if uid is None or code > LAST_STATUS:
                continue
            t_ns = begun_ns + (low | high << 32) * 1000
            if t_ns > told_ns:
                told_ns = t_ns if t_ns < until_ns else until_ns
            yield told_ns, uid, code

    def correct(self, statuses: Mapping[int, Status], now_s: float) -> None:
        """Takes statuses that no transition has told, such as those at the begin."""
        known, now_ns = self._statuses, _ns(now_s)
        changes: list[Change] = []
        for number, status in statuses.items():
            uid, code = self._tree.numbers.get(number), STATUS_CODES[status]
            if uid is not None and known.get(uid, 0) != code:
                changes.append((now_ns, uid, code))
        if self._log is not None:
            self._log.changes(changes)
        else:
            self._first.update({uid: code for _, uid, code in changes})
        self.told_ns = max(self.told_ns, _ns(now_s))

    def written(self, rows: Sequence[EntryRow], now_s: float) -> None:
        """Takes entries of the blackboard that changed."""
        for row in rows:
            if row[4]:
                self._entries.pop(row[:2], None)
            else:
                self._entries[row[0], row[1]] = row
        self.told_ns = max(self.told_ns, _ns(now_s))
        if self._log is not None:
            self._log.entries(self.told_ns, rows)

    def end_step(self) -> None:
        """Writes the changes that are still waiting for more of the same tick."""
        if self._log is not None:
            self._log.end_step()


def _ns(t_s: float) -> int:
    return max(0, round(t_s * 1e9))
