"""Places that all workers of a server share; the next one goes to the waiting owner who holds the fewest.

Workers of one parent share a board, a file in the parent's folder that is locked for each change. A server
without a parent keeps its board in memory. What a killed worker held is free at the next change.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import threading
import time
import uuid
from collections import Counter
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import psutil

from backend.core.processes.shares import Wish, order
from backend.core.processes.siblings import PLACES, siblings

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class Share(NamedTuple):
    """The limits of places.

    Attributes:
        most: the number of places of all owners.
        own: the number of places that one owner may hold; 0 is no limit.
        own_waiting: the number of an owner's wishes that may wait; 0 is no limit.
    """

    most: int
    own: int = 0
    own_waiting: int = 0


class Turn(NamedTuple):
    """The turn of a wish.

    Attributes:
        before: the number of those that get a place before it.
        is_own: whether it waits until its owner gives a place back.
    """

    before: int
    is_own: bool


class FairPlaces:
    """A limited number of places of one kind.

    Args:
        name: the kind.
    """

    def __init__(self, name: str) -> None:
        self._file = hashlib.sha256(name.encode()).hexdigest()[:32] + ".board"
        self._own: dict[str, Any] = _empty()
        self._lock = threading.Lock()

    def enter(self, owner: str, share: Share, *, about: str = "", is_exempt: bool = False) -> Ticket | None:
        """Returns a ticket for a place, which may have to wait; None if it is refused.

        Args:
            owner: who wants it.
            share: the limits.
            about: for what it is wanted, so that `turn_of` finds it.
            is_exempt: whether it goes first, and the limits of its owner do not hold.
        """
        if not share.most:
            return None
        ticket = Ticket(self, f"{about} {uuid.uuid4().hex}", share)
        with self.board() as board:
            board["waiting"][ticket.key] = [owner, time.monotonic(), is_exempt, *_this_process()]
            hand_out(board, share)
            own = sum(wish[0] == owner for wish in board["waiting"].values())
            is_too_many = not is_exempt and 0 < share.own_waiting < own
            if is_too_many and board["waiting"].pop(ticket.key, None) is not None:
                return None
        return ticket

    def turn_of(self, owner: str, share: Share, *, about: str) -> Turn | None:
        """Returns the turn of an owner's wish; of several, that of the last one. None if none waits."""
        with self.board() as board:
            turns = {key: turn for key, turn in _turns(board, share).items() if key.startswith(f"{about} ")}
            own = [turn for key, turn in turns.items() if board["waiting"][key][0] == owner]
        return own[-1] if own else None

    def end(self, owner: str, *, about: str) -> bool:
        """Ends an owner's wishes, and asks for the places that are held; returns whether there are any.

        A place stays held until its holder gives it back.
        """
        with self.board() as board:
            found = [
                key
                for rows in (board["waiting"], board["held"])
                for key, row in rows.items()
                if row[0] == owner and key.startswith(f"{about} ") and key not in board["ended"]
            ]
            for key in found:
                *_, pid, started_s = board["waiting"].pop(key, None) or board["held"][key]
                board["ended"][key] = [owner, pid, started_s]
        return bool(found)

    @contextmanager
    def board(self) -> Iterator[dict[str, Any]]:
        """Returns what is held, waits and was ended, to be changed; nobody else changes it meanwhile."""
        if siblings.family is None:
            with self._lock:
                yield self._own
            return
        with _opened(siblings.family.folder / PLACES / self._file) as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            board = json.loads(os.pread(file, os.fstat(file).st_size, 0) or "null") or _empty()
            _forget_the_dead(board)
            yield board
            text = json.dumps(board).encode()
            os.pwrite(file, text, 0)
            os.ftruncate(file, len(text))


class Ticket:
    """A wish for a place, and then the place."""

    def __init__(self, places: FairPlaces, key: str, share: Share) -> None:
        self._places, self.key, self._share = places, key, share

    def turn(self) -> Turn | None:
        """Returns its turn; None if it waits no longer: it has a place, or is ended."""
        with self._places.board() as board:
            turns = _turns(board, self._share)
            return None if self.key in board["held"] or self.key in board["ended"] else turns[self.key]

    def is_ended(self) -> bool:
        """Returns whether its owner has ended it."""
        with self._places.board() as board:
            return self.key in board["ended"]

    def give_back(self) -> None:
        """Frees the place, or ends the wait; further calls do nothing."""
        with self._places.board() as board:
            for rows in board.values():
                rows.pop(self.key, None)


def hand_out(board: dict[str, Any], share: Share) -> None:
    """Gives the free places of a board to those who are next."""
    free = max(0, share.most - len(board["held"]))
    for wish in order(_wishes(board), _held(board), share.own).next[:free]:
        owner, _, _, *process = board["waiting"].pop(wish.key)
        board["held"][wish.key] = [owner, *process]


def _turns(board: dict[str, Any], share: Share) -> dict[str, Turn]:
    """Hands out the free places of a board, and returns the turns of those that wait, in their order."""
    hand_out(board, share)
    found = order(_wishes(board), _held(board), share.own)
    return {
        str(wish.key): Turn(before, is_own=before >= len(found.next))
        for before, wish in enumerate((*found.next, *found.held_up))
    }


def _empty() -> dict[str, Any]:
    return {"held": {}, "waiting": {}, "ended": {}}


def _wishes(board: dict[str, Any]) -> list[Wish]:
    rows = board["waiting"].items()
    return [Wish(key, owner, since, is_exempt) for key, (owner, since, is_exempt, *_) in rows]


def _held(board: dict[str, Any]) -> Counter[Any]:
    return Counter(owner for owner, *_ in board["held"].values())


def _this_process() -> tuple[int, float]:
    return os.getpid(), _started_s(os.getpid())


def _started_s(pid: int) -> float:
    """Returns when a process started, which distinguishes it from a later one with its number; 0 if none."""
    try:
        return psutil.Process(pid).create_time()
    except psutil.Error:
        return 0.0


def _forget_the_dead(board: dict[str, Any]) -> None:
    rows = [(name, key, tuple(row[-2:])) for name in board for key, row in board[name].items()]
    alive = {process: _started_s(process[0]) == process[1] for process in {row[2] for row in rows}}
    for name, key, process in rows:
        if not alive[process]:
            del board[name][key]


@contextmanager
def _opened(path: Path) -> Iterator[int]:
    file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    try:
        yield file
    finally:
        os.close(file)


editors: Final = FairPlaces("language server")
"""The places of editors that get help with Python."""
testers: Final = FairPlaces("test with Python")
"""The places of tests that run users' Python."""
