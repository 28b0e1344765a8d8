"""Sends the transitions of another program's tree to the recorder of the session."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final

from executor.attached.followed_tree import FollowedTree
from executor.recorder.link import Record, RecorderLink, Until

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from executor.messages import TreeNode

__all__ = ["AttachedRecorder"]

GOODBYE_S: Final = 0.2


class AttachedRecorder(FollowedTree):
    """Records a tree that runs elsewhere. Times of the session are in s.

    Args:
        nodes: the nodes of the tree.
        numbers: our uid of each node, by its uid in the other program.
        address: the address of the recorder; "" if nothing is recorded.
        clock: returns the time of this machine in s, for batches.
    """

    def __init__(
        self,
        nodes: Sequence[TreeNode],
        numbers: dict[int, int],
        address: str,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        super().__init__(nodes, numbers)
        self._link = RecorderLink(address, lambda: self.restate(self), clock, self._gathered)
        self.is_wanted = False

    def begin(self, run: str) -> None:
        """Begins the recording of a run."""
        self.is_wanted = True
        self._link.begin(run)

    def pump(self) -> None:
        """Sends the waiting messages. Called many times in a second."""
        self._link.pump()

    def close(self) -> None:
        """Sends the last messages."""
        self.end_step()
        self._link.flush(GOODBYE_S)
        self._link.close()

    def record(self, topic: str, name: str, fields: dict[str, Any]) -> None:
        """Sends a message to the recorder."""
        self._link.send(Record(topic, name, dict(fields)))

    def attach(self, name: str, media_type: str, data: bytes) -> None:
        """Does nothing: the recorder attaches the diagrams itself."""

    def _gathered(self) -> Iterator[Until]:
        self.end_step()
        yield Until(self.told_ns)
