"""Watches executors: each is pinged every second, and ended if it is silent for too long.

Beyond 500 sessions each is pinged less often, at least every two seconds.

The web server that maintains the sessions (`maintenance.py`) watches all of them, and each server watches the
sessions of its own open pages. The first server that finds a session silent for too long ends it, and the
others see that it has ended. So a session without open pages is watched too, and so is a session whose server
has ended.

Silence is counted only while this server itself runs: after a second in which it had no processor or was
stopped, the answer has probably arrived and is only not read yet.
"""

from __future__ import annotations

import asyncio
import logging
from collections import Counter
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Final
from weakref import WeakKeyDictionary

from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus
from websockets.protocol import State

from backend.config.environment import environment
from backend.core.tasks import ended
from backend.sessions.lifecycle import writes
from backend.sessions.manager.sockets import manager_socket

if TYPE_CHECKING:
    from collections.abc import Awaitable, Iterable, Iterator
    from uuid import UUID

    from websockets.asyncio.client import ClientConnection

    from backend.sessions.models import Session

log = logging.getLogger(__name__)

PING_EVERY_S: Final = 1.0
SELDOM_S: Final = 2.0
"""The longest time between two pings; an answer to each is never so old that silence would be noted."""
PINGS_A_SECOND: Final = 500
NOTED_S: Final = 3.0


def longest_s() -> float:
    """Returns the time, in seconds, for which a manager may be silent."""
    return environment().session_silence_s


def why() -> str:
    """Returns the text that explains the end of a session whose manager was silent."""
    return f"The session did not answer for {longest_s():g} s, so it was ended."


class Silence:
    """Measures for how long a manager has not answered."""

    def __init__(self) -> None:
        self.seconds = 0.0
        self._was_heard = False
        self._is_reached = True

    def heard(self) -> None:
        """Notes an answer."""
        self.seconds, self._was_heard, self._is_reached = 0.0, True, True

    def not_reached(self) -> None:
        """Notes that no process listens at the manager's address.

        If the manager answered before, it has closed its socket and hangs at its end. If it never answered,
        it cannot be reached from this server, and its state is unknown.
        """
        self._is_reached = self._was_heard
        self.seconds = self.seconds if self._was_heard else 0.0

    def passed(self, seconds: float) -> None:
        """Counts time without an answer; delays of this server itself do not count."""
        if self._is_reached:
            self.seconds += min(seconds, PING_EVERY_S)


class Watched:
    """A session that is watched: its socket, and the ping that its manager has not answered yet."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.silence = Silence()
        self.is_silent: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._socket: ClientConnection | None = None
        self._answer: Awaitable[float] | None = None
        self._asked_s = 0.0
        self._is_noted = False

    @contextmanager
    def by(self, socket: ClientConnection) -> Iterator[None]:
        """Watches by this socket, whose opening was an answer."""
        self.silence.heard()
        self._asked_s = asyncio.get_running_loop().time()
        self._socket = socket
        try:
            yield
        finally:
            self._socket = self._answer = None

    def look(self, passed_s: float) -> None:
        """Takes an answer that came, or counts the time since the last look as silence."""
        if isinstance(self._answer, asyncio.Future) and self._answer.done():
            if not self._answer.cancelled() and self._answer.exception() is None:
                self.silence.heard()
            self._answer = None
        self.silence.passed(passed_s)
        is_noted = self.silence.seconds >= NOTED_S
        if is_noted is not self._is_noted:
            self._is_noted = is_noted
            answers = "is silent" if is_noted else "answers"
            log.warning("session %s: the executor %s", self.session.id, answers)
        if self.silence.seconds >= longest_s() and not self.is_silent.done():
            self.is_silent.set_result(None)

    async def ask(self, now_s: float, period_s: float) -> None:
        """Sends a ping if the last one was answered, and is old enough.

        A socket that closes is left alone: a ping would wait for its end, and all other sessions with it.
        """
        if self._socket is None or self._socket.state is not State.OPEN:
            return
        if self._answer is not None or now_s - self._asked_s < period_s:
            return
        self._asked_s = now_s
        with suppress(ConnectionClosed):
            self._answer = await self._socket.ping()


class Pulse:
    """Looks at all watched sessions of an event loop together, which costs a quarter of a task for each."""

    def __init__(self) -> None:
        self._watched: dict[Watched, None] = {}
        self._beating: asyncio.Task[None] | None = None

    async def until_silent(self, watched: Watched) -> None:
        """Waits until a manager has been silent for too long."""
        self._watched[watched] = None
        if self._beating is None or self._beating.done():
            self._beating = asyncio.create_task(self._beat())
        try:
            await watched.is_silent
        finally:
            del self._watched[watched]

    async def _beat(self) -> None:
        loop = asyncio.get_running_loop()
        looked_s = loop.time()
        while self._watched:
            await asyncio.sleep(PING_EVERY_S / 2)  # a look that is a little late still counts as a whole
            now_s = loop.time()
            period_s = min(max(PING_EVERY_S, len(self._watched) / PINGS_A_SECOND), SELDOM_S)
            for watched in list(self._watched):
                try:
                    watched.look(now_s - looked_s)
                    await watched.ask(now_s, period_s)
                except Exception:  # one session must not end the watch of the others
                    log.exception("session %s: its executor was not asked", watched.session.id)
            looked_s = now_s


_pulses: Final[WeakKeyDictionary[asyncio.AbstractEventLoop, Pulse]] = WeakKeyDictionary()


async def until_silent(session: Session) -> None:
    """Waits until the session's manager has not answered for too long."""
    watched = Watched(session)
    keeping = asyncio.create_task(_keep_open(watched))
    try:
        await _pulses.setdefault(asyncio.get_running_loop(), Pulse()).until_silent(watched)
    finally:
        await ended(keeping)


async def _keep_open(watched: Watched) -> None:
    silence = watched.silence
    while True:
        try:
            async with manager_socket(watched.session, "watch") as socket:
                try:
                    with watched.by(socket):
                        await socket.wait_closed()
                except asyncio.CancelledError:
                    if silence.seconds >= longest_s():
                        socket.transport.abort()  # it would not answer the closing either
                    raise
        except InvalidStatus:
            silence.heard()  # a manager of an older version has no such socket, but its refusal is an answer
        except (ConnectionClosed, TimeoutError, InvalidHandshake):
            pass  # the manager can be reached, which is enough
        except OSError:
            silence.not_reached()
        await asyncio.sleep(PING_EVERY_S)


class Watchmen:
    """The tasks that watch the sessions of this server."""

    def __init__(self) -> None:
        self._tasks: dict[UUID, asyncio.Task[None]] = {}
        self._looked_at: Counter[UUID] = Counter()

    @contextmanager
    def beside_page(self, session: Session) -> Iterator[None]:
        """Watches a session while one of its sockets is open on this server."""
        self._looked_at[session.id] += 1
        self.look_after(session)
        try:
            yield
        finally:
            self._looked_at[session.id] -= 1
            if not self._looked_at[session.id]:
                del self._looked_at[session.id]

    def look_after(self, session: Session) -> None:
        """Starts to watch a ready session, unless it is already watched."""
        task = self._tasks.get(session.id)
        if task is None or task.done():
            self._tasks[session.id] = asyncio.create_task(_look_after(session))

    def keep_to(self, sessions: Iterable[Session], *, all_of_them: bool = True) -> None:
        """Stops watching all sessions except these, and except those with an open page on this server."""
        ready = {each.id: each for each in sessions if all_of_them or each.id in self._looked_at}
        for session_id in self._tasks.keys() - ready.keys():
            self._tasks.pop(session_id).cancel()
        for session in ready.values():
            self.look_after(session)


async def _look_after(session: Session) -> None:
    await until_silent(session)
    try:
        await asyncio.to_thread(writes.fail_session, session.id, why())
    except Exception:
        # The next round of maintenance starts it again.
        log.exception("session %s: a silent executor was not ended", session.id)


watchmen: Final = Watchmen()
