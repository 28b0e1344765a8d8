"""Watches executors: each is pinged every second, and ended if it is silent for too long.

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
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from websockets.exceptions import ConnectionClosed, InvalidHandshake, InvalidStatus

from backend.config.environment import environment
from backend.sessions import writes
from backend.sessions.manager.sockets import manager_socket

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from uuid import UUID

    from backend.sessions.models import Session

log = logging.getLogger(__name__)

PING_EVERY_S: Final = 1.0
NOTED_S: Final = 3.0


def longest_s() -> float:
    """Returns the time, in seconds, for which a manager may be silent."""
    return environment().session_silence_s


def why() -> str:
    """Returns the text that explains the end of a session whose manager was silent."""
    return f"The executor did not answer for {longest_s():g} s, so it was ended."


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


async def until_silent(session: Session) -> None:
    """Waits until the session's manager has not answered for too long."""
    silence = Silence()
    asking = asyncio.create_task(_ask(session, silence))
    loop = asyncio.get_running_loop()
    try:
        looked_s, is_noted = loop.time(), False
        while silence.seconds < longest_s():
            await asyncio.sleep(PING_EVERY_S / 2)  # a look that is a little late still counts as a whole
            now_s = loop.time()
            silence.passed(now_s - looked_s)
            looked_s = now_s
            if is_noted is not (is_noted := silence.seconds >= NOTED_S):
                log.warning("session %s: the executor %s", session.id, "is silent" if is_noted else "answers")
    finally:
        asking.cancel()
        await asyncio.gather(asking, return_exceptions=True)


async def _ask(session: Session, silence: Silence) -> None:
    while True:
        try:
            async with manager_socket(session, "watch") as socket:
                try:
                    while True:
                        silence.heard()
                        await asyncio.sleep(PING_EVERY_S)
                        await (await socket.ping())
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
        while not await asyncio.to_thread(writes.is_reached, session):
            # `maintenance` gives up the host if it stays away; the executor may be well.
            await until_silent(session)
        await asyncio.to_thread(writes.fail_session, session.id, why())
    except Exception:
        # The next round of maintenance starts it again.
        log.exception("session %s: a silent executor was not ended", session.id)


watchmen: Final = Watchmen()
