"""Maintains sessions every few seconds: marks dead sessions, ends idle ones, and starts waiting ones.

`backend.sessions.watch` handles sessions that are alive and do not answer.

If there are several web servers, or several workers of one, the one that holds the lease does this for all
(`lease.py`). Each step is correct even if another server did it a moment before. Each server itself notes
which browsers are connected to it, since no other server knows this, and notifies its own browsers.
"""

from __future__ import annotations

import asyncio
import itertools
import json
import logging
import time
from collections import defaultdict
from contextlib import contextmanager
from datetime import timedelta
from typing import TYPE_CHECKING, Final

from channels.db import database_sync_to_async
from django.db import Error
from django.db.models import Q
from django.utils import timezone

from backend.config.environment import environment
from backend.projects.api.open_pages import pages
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.idleness import Ages
from backend.sessions.lease import CARE, holder, is_alone
from backend.sessions.lifecycle import drain, orphans, writes
from backend.sessions.manager.holds import is_held
from backend.sessions.models import Session
from backend.sessions.signals import sessions_maintained
from backend.sessions.warm.pool import end_leftovers, keep_warm
from backend.sessions.watch import watchmen

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Mapping
    from uuid import UUID

    from asgiref.typing import ASGISendCallable

log = logging.getLogger(__name__)

EVERY_S: Final = 5.0
LEASE_S: Final = 3 * EVERY_S
"""Seconds without a sign of life from the holder of the lease after which another server takes it."""
ROUNDS_TO_ORPHANS: Final = 12
WARNING: Final = timedelta(minutes=5)
_AT_ONCE: Final = timedelta(seconds=1)


class Attendance:
    """The browsers of each session on this server, and the time of their last message."""

    def __init__(self) -> None:
        self._used: dict[UUID, float] = {}
        self._browsers: dict[UUID, set[ASGISendCallable]] = defaultdict(set)
        self._warned: set[UUID] = set()
        self._told: dict[ASGISendCallable, str] = {}

    def join(self, session_id: UUID, send: ASGISendCallable) -> None:
        """Adds a browser that opened its control socket."""
        self._browsers[session_id].add(send)
        self.use(session_id)

    def leave(self, session_id: UUID, send: ASGISendCallable) -> None:
        """Removes a browser."""
        self._browsers[session_id].discard(send)
        self._told.pop(send, None)
        if not self._browsers[session_id]:
            self._browsers.pop(session_id)

    def use(self, session_id: UUID) -> None:
        """Notes a message of a browser to its session."""
        self._used[session_id] = time.monotonic()
        self._warned.discard(session_id)

    def take_used(self) -> dict[UUID, float]:
        """Returns the seconds since the last use of each session that was used since the last call."""
        used, self._used = self._used, {}
        now = time.monotonic()
        return {session_id: now - at for session_id, at in used.items()}

    async def tell(self, text: str) -> None:
        """Writes a line about the server into the console of every browser, once for each text."""
        for send in [send for browsers in self._browsers.values() for send in browsers]:
            if text and self._told.get(send) != text:
                await say(send, "log", {"source": "manager", "level": "warning", "text": text})
            self._told[send] = text

    def keep_warned(self, soon: Container[UUID]) -> None:
        """Removes the warning mark from all other sessions, since these were used again."""
        self._warned = {session_id for session_id in self._warned if session_id in soon}

    async def warn(self, session_id: UUID, text: str) -> None:
        """Writes a line into the console of each browser of a session, once until it is used again."""
        if session_id in self._warned:
            return
        self._warned.add(session_id)
        data = {"source": "manager", "level": "warning", "text": text}
        for send in list(self._browsers.get(session_id, ())):
            await say(send, "log", data)


attendance: Final = Attendance()
ages_of_use: Final = Ages()
"""How long each session has not been used."""


async def say(send: ASGISendCallable, command: str, data: Mapping[str, object]) -> None:
    """Sends a message to a browser in the manager's format."""
    message = {"id": "", "command": command, "data": data, "seq": 0, "t": 0}
    try:
        await send({"type": "websocket.send", "text": json.dumps(message), "bytes": None})
    except (OSError, RuntimeError) as error:  # the browser has disconnected
        log.debug("a browser was not told: %s", error)


def begin() -> None:
    """Ends the executors of a killed server unless other servers do; called before the first request."""
    if is_alone():
        orphans.end_orphans()


async def care_for_ever() -> None:
    """Maintains sessions until it is cancelled; a step that fails is tried again."""
    rounds_held = itertools.count()
    try:
        while True:
            try:
                await one_round(rounds_held)
            except Exception:
                log.exception("the sessions were not looked after")
            await asyncio.sleep(EVERY_S)
    finally:
        await database_sync_to_async(_give_back)()


async def one_round(rounds_held: Iterator[int]) -> None:
    """Runs one round of maintenance.

    Args:
        rounds_held: counts the rounds in which this server has the lease. In the first one it ends what a
            server left that died with the lease.
    """
    is_ours = await database_sync_to_async(holder.hold)(CARE, LEASE_S)
    watchmen.keep_to(await database_sync_to_async(ready_sessions)(), all_of_them=is_ours)
    await database_sync_to_async(note_used)(attendance.take_used())
    if is_ours:
        is_for_orphans = next(rounds_held) % ROUNDS_TO_ORPHANS == 0 and not is_alone()
        await database_sync_to_async(maintain)(is_for_orphans=is_for_orphans)
    soon = await database_sync_to_async(ending_soon)()
    text = await database_sync_to_async(drain.text)()
    await pages.tell(text)
    await attendance.tell(text)
    attendance.keep_warned(soon)
    for session_id, minutes in soon.items():
        await attendance.warn(
            session_id, f"This session is not being used. It ends in {minutes} min unless you use it."
        )


def _give_back() -> None:
    """Releases the lease of a server that ends, so that another server need not wait for its expiry."""
    try:
        holder.give_back(CARE)
    except Error as error:
        log.debug("the lease runs out by itself: %s", error)


def note_used(used: Mapping[UUID, float]) -> None:
    """Stores when each session was last used on this server, unless another server stored a later time.

    A time in the future was stored before the clock was set back.

    Args:
        used: the seconds since the last use, by session.
    """
    now = timezone.now()
    for session_id, seconds in used.items():
        at = now - timedelta(seconds=seconds)
        is_older = Q(used_at=None) | Q(used_at__lt=at) | Q(used_at__gt=now)
        Session.objects.filter(is_older, id=session_id).update(used_at=at)


def maintain(*, is_for_orphans: bool = False) -> None:
    """Runs one round of maintenance for all servers; a step that fails does not stop the others."""
    if is_for_orphans:
        for chore in (orphans.end_orphans, writes.launcher().tidy, end_leftovers):
            with _step("what earlier servers left was not ended"):
                chore()
    for session in ready_sessions():
        with _step("session %s was not looked at", session.id):
            writes.refresh(session)
    end_idle()
    with _step("waiting sessions were not started"):
        writes.start_queued()
    with _step("no executors were kept warm"):
        keep_warm()
    sessions_maintained.send_robust(Session)


@contextmanager
def _step(failure: str, *values: object) -> Iterator[None]:
    """Logs an error of one step of the round; without the database no step is possible."""
    try:
        yield
    except Error:
        raise
    except Exception:
        log.exception(failure, *values)


def ready_sessions() -> list[Session]:
    """Returns the sessions whose executors must answer."""
    return list(Session.objects.filter(state=SessionState.READY))


def end_idle() -> None:
    """Ends sessions that have not been used for too long."""
    for session, left in _unused():
        if left <= timedelta(0):
            log.info("session %s is idle and is ended", session.id)
            with _step("the idle session %s was not ended", session.id):
                writes.end_session(session, "It was ended because it was not used.")


def ending_soon() -> dict[UUID, int]:
    """Returns the idle sessions that end soon, with the minutes left."""
    soon = {session.id: left for session, left in _unused() if left > timedelta(0)}
    return {session_id: max(1, round(left.total_seconds() / 60)) for session_id, left in soon.items()}


def _unused() -> list[tuple[Session, timedelta]]:
    """Returns the sessions that have not been used for long, and the time left until each is ended.

    One whose tree a debugger holds is in use.
    """
    limit = timedelta(minutes=environment().session_idle_minutes)
    if not limit:
        return []
    ready = Session.objects.filter(state=SessionState.READY, kind=SessionKind.INTERACTIVE)
    times = {session.id: session.used_at or session.created_at for session in ready}
    # After a start of the server nobody is ended without a warning.
    ages = ages_of_use.of(times, at_first=limit - WARNING)
    rows = [session for session in ready if ages[session.id] > limit - WARNING - _AT_ONCE]
    held = [session for session in rows if is_held(session)]
    note_used({session.id: 0.0 for session in held})
    return [(session, limit - ages[session.id]) for session in rows if session not in held]
