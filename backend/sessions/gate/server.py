"""The loop of the gate: one thread, which no connection can block or end.

At the entrance of the keeper, a request is one line of JSON, `{"door", "session", "token"}`, with a listening
socket. The answer is `open`, and later `taken` when a session has fetched the socket. The door is open until
the keeper closes its connection. Otherwise the answer is one of `REFUSALS`, and the connection is closed.

At a door, a request is one line of JSON, `{"session", "token"}`. The answer is `listen` with the socket, or
`refused`.
"""

from __future__ import annotations

import errno
import hmac
import json
import logging
import os
import selectors
import socket
import time
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Final

from backend.sessions.gate.callers import Caller, Callers
from backend.sessions.gate.doors import DOOR_NAME, Doors, listen_at

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

log = logging.getLogger(__name__)

OPEN: Final = b"open\n"
TAKEN: Final = b"taken\n"
LISTEN: Final = b"listen\n"
REFUSED: Final = b"refused\n"
REFUSALS: Final = {
    b"bad\n": "the request is not one that it knows",
    b"full\n": "all its doors are open",
    b"failed\n": "it has no descriptors or no room left",
}
MAX_LINE_BYTES: Final = 4096
ACCEPTS_A_ROUND: Final = 32
ONLY_KEEPER: Final = 0o660  # the group of the folder may connect
EXHAUSTED: Final = frozenset({errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM})
BACK_OFF_S: Final = 0.05
LOG_EVERY_S: Final = 10.0
IDLE_S: Final = 5.0


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of the gate. All doors and connections together need fewer than 1,024 descriptors.

    Attributes:
        doors: sessions that start at the same time; each needs three descriptors.
        per_door: connections at one door that have not sent a token yet.
        callers: connections at all doors that have not sent a token yet.
        hand_over_s: seconds in which a connection must send its token.
        age_s: seconds in which a session must connect.
    """

    doors: int = 256
    per_door: int = 8
    callers: int = 128
    hand_over_s: float = 5
    age_s: float = 600


@dataclass(eq=False, slots=True)
class _Door:
    name: str
    session: str
    token: bytes
    listener: socket.socket
    handed: socket.socket
    keeper: socket.socket
    closes_s: float


class GateServer:
    """Opens doors for the keeper, and passes sockets to sessions.

    Args:
        doors: the folder of the doors.
        control: the path of the keeper's entrance, a socket in a folder that only keeper and gate see.
    """

    def __init__(
        self,
        doors: Doors,
        control: Path,
        limits: Limits = Limits(),
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._folders = doors
        self._limits = limits
        self._clock = clock
        self._doors: dict[str, _Door] = {}
        self._callers = Callers(per_door=limits.per_door, in_all=limits.callers)
        self._dropped: Counter[str] = Counter()
        self._logged_s = clock()
        self._is_exhausted = False
        self._is_ended = False
        control.parent.mkdir(parents=True, exist_ok=True)
        self._control = listen_at(control, ONLY_KEEPER)
        self._control.settimeout(0)
        self._selector = selectors.DefaultSelector()
        self._wakes, self._waker = socket.socketpair()
        for one in (self._wakes, self._waker):
            one.settimeout(0)
        self._watch(self._wakes, lambda: None)
        self._watch(self._control, partial(self._accept, self._control, ""))

    def serve(self) -> None:
        """Serves until `end` is called."""
        while not self._is_ended:
            self.step(0.5 if self._callers else IDLE_S)
        self._close()

    def end(self) -> None:
        """Makes `serve` return; may be called by a signal handler or another thread."""
        self._is_ended = True
        with suppress(OSError):  # the loop has ended
            self._waker.send(b"e")

    def step(self, timeout_s: float) -> None:
        """Handles all connections that are ready, then those whose time is over."""
        for key, _ in self._selector.select(timeout_s):
            try:
                key.data()
            except Exception:  # no connection may end the loop
                log.exception("a connection failed")
        now_s = self._clock()
        for caller in self._callers.overdue(now_s):
            self._drop(caller, "too slow")
        for door in [one for one in self._doors.values() if one.closes_s <= now_s]:
            log.warning("session %s never came", door.session)
            self._close_door(door)
        if self._dropped and now_s - self._logged_s >= LOG_EVERY_S:
            log.warning("connections dropped: %s", dict(self._dropped))
            self._dropped.clear()
            self._logged_s = now_s
        if self._is_exhausted:
            # No connection is left that could be closed: only waiting helps.
            self._is_exhausted = False
            time.sleep(BACK_OFF_S)

    def _watch(self, connection: socket.socket, handle: Callable[[], None]) -> None:
        self._selector.register(connection, selectors.EVENT_READ, handle)

    def _accept(self, listener: socket.socket, door: str) -> None:
        for _ in range(ACCEPTS_A_ROUND):
            if listener.fileno() < 0:  # the last caller has fetched the door's socket
                return
            try:
                connection, _ = listener.accept()
            except (BlockingIOError, ConnectionAbortedError, InterruptedError):
                return
            except OSError as error:
                self._make_room(error)
                return
            self._admit(connection, door)

    def _admit(self, connection: socket.socket, door: str) -> None:
        connection.settimeout(0)
        caller = Caller(connection, door, self._clock() + self._limits.hand_over_s)
        for other in self._callers.add(caller):
            self._end(other, "gave way")
        hear = self._hear if door else self._hear_keeper
        try:
            self._watch(connection, partial(hear, caller))
        except OSError as error:
            self._drop(caller, "no room")
            self._make_room(error)
            return
        hear(caller)  # an honest caller has sent its request by now, and so is never closed for another one

    def _make_room(self, error: OSError) -> None:
        """Closes a connection after `accept` failed for lack of descriptors.

        Without a connection to close, notes the lack.
        """
        if error.errno not in EXHAUSTED:
            log.warning("accept: %s", error)
        victim = self._callers.first_to_go()
        if victim is None:
            self._is_exhausted = True
        else:
            self._drop(victim, "out of descriptors")

    def _hear(self, caller: Caller) -> None:
        if caller not in self._callers:  # closed earlier in this round
            return
        try:
            data = caller.connection.recv(MAX_LINE_BYTES)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        caller.heard += data
        if b"\n" in caller.heard:
            self._hand_over(caller, self._doors[caller.door])
        elif not data or len(caller.heard) >= MAX_LINE_BYTES:
            self._drop(caller, "no request")

    def _hand_over(self, caller: Caller, door: _Door) -> None:
        said = _read(caller.heard, ("session", "token"))
        shown = said.get("token", "").encode()
        if said.get("session") != door.session or not hmac.compare_digest(door.token, shown):
            self._say(caller.connection, REFUSED)
            self._drop(caller, "refused")
            return
        try:
            socket.send_fds(caller.connection, [LISTEN], [door.handed.fileno()])
        except OSError:
            self._drop(caller, "went away")
            return
        self._close_door(door, TAKEN)

    def _hear_keeper(self, caller: Caller) -> None:
        if caller not in self._callers:
            return
        try:
            data, descriptors, _, _ = socket.recv_fds(caller.connection, MAX_LINE_BYTES, 1)
        except BlockingIOError:
            return
        except OSError:
            data, descriptors = b"", []
        caller.descriptors += descriptors
        caller.heard += data
        if b"\n" in caller.heard:
            self._callers.discard(caller)  # it no longer waits, and cannot be closed for another one
            answer = self._open(caller)
            self._say(caller.connection, answer)
            if answer != OPEN:
                self._end(caller, "refused to the keeper")
        elif not data or len(caller.heard) >= MAX_LINE_BYTES:
            self._drop(caller, "no request")

    def _open(self, caller: Caller) -> bytes:
        """Opens a door if possible; returns the answer."""
        said = _read(caller.heard, ("door", "session", "token"))
        if not said or not DOOR_NAME.fullmatch(said["door"]) or said["door"] in self._doors:
            return b"bad\n"
        if len(self._doors) >= self._limits.doors:
            return b"full\n"
        if len(caller.descriptors) != 1:  # the kernel omits the descriptor when this process has none left
            self._make_room(OSError(errno.EMFILE, "no descriptor"))
            return b"failed\n"
        try:
            listener = self._folders.make(said["door"])
            self._watch(listener, partial(self._accept, listener, said["door"]))
        except OSError as error:
            self._folders.remove(said["door"])
            self._make_room(error)
            return b"failed\n"
        handed = socket.socket(fileno=caller.descriptors.pop())
        closes_s = self._clock() + self._limits.age_s
        token = said["token"].encode()
        door = _Door(said["door"], said["session"], token, listener, handed, caller.connection, closes_s)
        self._doors[door.name] = door
        # The keeper sends nothing more: the next event is the end of its connection.
        self._selector.modify(caller.connection, selectors.EVENT_READ, partial(self._close_door, door))
        return OPEN

    def _say(self, connection: socket.socket, words: bytes) -> None:
        try:
            connection.send(words)
        except OSError as error:
            log.info("an answer was not heard: %s", error)

    def _drop(self, caller: Caller, why: str) -> None:
        self._callers.discard(caller)
        self._end(caller, why)

    def _end(self, caller: Caller, why: str) -> None:
        self._dropped[why] += 1
        self._release(caller.connection)
        for descriptor in caller.descriptors:
            os.close(descriptor)
        caller.descriptors.clear()

    def _close_door(self, door: _Door, answer: bytes = b"") -> None:
        if self._doors.pop(door.name, None) is None:
            return
        for caller in self._callers.at(door.name):
            self._callers.discard(caller)
            self._release(caller.connection)
        self._folders.remove(door.name)
        if answer:
            self._say(door.keeper, answer)
        for one in (door.listener, door.keeper):
            self._release(one)
        door.handed.close()

    def _release(self, connection: socket.socket) -> None:
        with suppress(KeyError, ValueError):
            self._selector.unregister(connection)
        connection.close()

    def _close(self) -> None:
        for door in list(self._doors.values()):
            self._close_door(door)
        for caller in list(self._callers):
            self._drop(caller, "the gate ends")
        for one in (self._control, self._wakes):
            self._release(one)
        self._waker.close()
        self._selector.close()
        self._folders.close()


def _read(line: bytes, names: tuple[str, ...]) -> dict[str, str]:
    """Returns the request in a line of JSON; empty unless it has exactly these names, each with a text."""
    try:
        said = json.loads(line)
    except (ValueError, RecursionError):
        return {}
    if not isinstance(said, dict) or set(said) != set(names):
        return {}
    return said if all(isinstance(text, str) for text in said.values()) else {}
