"""Writes what another program's tree does into a recording."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final

from executor.attached.document import document_of
from executor.attached.followed_tree import FollowedTree
from executor.attached.following import Boards
from executor.headless.errors import HeadlessError
from executor.headless.recording import Recording, check_name

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from tree_gardener.groot.client import Groot2Client
    from tree_gardener.groot.remote import RemoteTree

__all__ = ["AttachedFile"]

FLUSH_S: Final = 1.0


class AttachedFile:
    """A recording of what a client of Groot2's protocol sees; close it at the end.

    A tree that comes later, as of a program that was started again, is another tree of the same recording.
    A full disk stops the recording, not the following.

    Args:
        path: the file, an MCAP.
        address: the address of the other program.
        clock: returns the time of this machine in s.

    Raises:
        HeadlessError: the file cannot be written, or its name is not one of a recording.
    """

    def __init__(self, path: Path, address: str, clock: Callable[[], float] = time.monotonic) -> None:
        check_name(path)
        try:
            self._file = Recording(path, {"project": "", "attached": address}, {})
        except OSError as error:
            raise HeadlessError(f"{path}: cannot be written: {error.strerror}") from error
        self._clock = clock
        self._began_s = clock()
        self._flush_s = 0.0
        self._tree: FollowedTree | None = None
        self._boards = Boards()
        self._main = ""
        self._since_s = 0.0

    def tree(self, tree: RemoteTree, client: Groot2Client) -> None:
        """Begins a tree; the other program keeps its transitions from now on.

        Raises:
            GrootError, TranslatorError: it cannot be shown, or the program does not answer.
        """
        document = document_of(tree)
        if (before := self._tree) is not None:
            before.end_step()
        generation, told_ns = (0, 0) if before is None else (before.generation, before.told_ns)
        made = FollowedTree(document.nodes, document.numbers, document.xml.encode(), generation, told_ns)
        self._boards, self._main = Boards(), tree.scopes[0] if tree.scopes else ""
        self._tree = made
        self.resume(client)
        self._write(lambda: made.restate(self))

    def resume(self, client: Groot2Client) -> None:
        """Asks the program to keep its transitions: it may be another process, or have forgotten us.

        Raises:
            GrootError: it does not answer.
        """
        tree = self._tree
        if tree is None:
            return
        client.record(on=True)
        self._since_s = self._now_s()
        states, _ = client.statuses()
        now_s = self._now_s()
        self._write(lambda: tree.correct({uid: state.status for uid, state in states.items()}, now_s))

    def look(self, client: Groot2Client, boards: Mapping[str, dict[str, Any]]) -> None:
        """Writes the transitions since the last look, and the changes of the blackboards.

        Raises:
            GrootError: the program does not answer.
        """
        tree = self._tree
        if tree is None or self._file.is_stopped:
            return
        transitions, _ = client.transitions()
        now_s = self._now_s()
        _, rows = self._boards.take(boards, self._main)
        self._write(lambda: tree.take(transitions, self._since_s, now_s))
        if rows:
            self._write(lambda: tree.written(rows, now_s))
        if now_s >= self._flush_s:
            self._flush_s = now_s + FLUSH_S
            self._write(tree.end_step)
            self._write(self._file.writer.flush)

    def close(self) -> None:
        """Completes the file."""
        if self._tree is not None:
            self._write(self._tree.end_step)
        self._file.close()

    def record(self, topic: str, name: str, fields: dict[str, Any]) -> None:
        """Writes a message."""
        self._file.writer.record(topic, name, fields)

    def attach(self, name: str, media_type: str, data: bytes) -> None:
        """Writes a file."""
        self._file.writer.attach(name, media_type, data)

    def _write(self, write: Callable[[], None]) -> None:
        if self._file.is_stopped:
            return
        try:
            write()
        except OSError as error:
            self._file.stop(error)

    def _now_s(self) -> float:
        return self._clock() - self._began_s
