"""What a server does for its sessions every few seconds: notes the dead, ends the idle, starts the waiting.

Those that are alive and do not answer are the business of `backend.sessions.watch`.

Several web servers may do so at once; each of the steps is right when another did it a moment before.
"""

from __future__ import annotations

import asyncio
import json
import logging
import time
from collections import defaultdict
from datetime import timedelta
from typing import TYPE_CHECKING, Final

from asgiref.sync import sync_to_async
from django.utils import timezone

from backend.config.environment import environment
from backend.projects.pages_open import pages
from backend.sessions import actions, drain
from backend.sessions.choices import SessionState
from backend.sessions.models import Session
from backend.sessions.watch import watchmen

if TYPE_CHECKING:
    from collections.abc import Mapping
    from uuid import UUID

    from asgiref.typing import ASGISendCallable

log = logging.getLogger(__name__)

EVERY_S: Final = 5.0
WARNING: Final = timedelta(minutes=5)


class Attendance:
    """Who looks at which session through this server, and when they last told it something."""

    def __init__(self) -> None:
        self._used: dict[UUID, float] = {}
        self._browsers: dict[UUID, set[ASGISendCallable]] = defaultdict(set)
        self._warned: set[UUID] = set()
        self._told: dict[ASGISendCallable, str] = {}

    def join(self, session_id: UUID, send: ASGISendCallable) -> None:
        """A browser opened its control socket."""
        self._browsers[session_id].add(send)
        self.use(session_id)

    def leave(self, session_id: UUID, send: ASGISendCallable) -> None:
        """It has gone."""
        self._browsers[session_id].discard(send)
        self._told.pop(send, None)
        if not self._browsers[session_id]:
            self._browsers.pop(session_id)

    def use(self, session_id: UUID) -> None:
        """A browser told its session something."""
        self._used[session_id] = time.monotonic()
        self._warned.discard(session_id)

    def take_used(self) -> dict[UUID, float]:
        """For how many seconds each has not been used, of those used since the last call."""
        used, self._used = self._used, {}
        now = time.monotonic()
        return {session_id: now - at for session_id, at in used.items()}

    async def tell(self, text: str) -> None:
        """Writes a line about the server into every console, once for each text."""
        for send in [send for browsers in self._browsers.values() for send in browsers]:
            if text and self._told.get(send) != text:
                await say(send, "log", {"source": "manager", "level": "warning", "text": text})
            self._told[send] = text

    async def warn(self, session_id: UUID, text: str) -> None:
        """Writes a line into the console of everyone who looks, once until it is used again."""
        if session_id in self._warned:
            return
        self._warned.add(session_id)
        data = {"source": "manager", "level": "warning", "text": text}
        for send in list(self._browsers.get(session_id, ())):
            await say(send, "log", data)


attendance: Final = Attendance()


async def say(send: ASGISendCallable, command: str, data: Mapping[str, object]) -> None:
    """Tells a browser something in the words of its manager."""
    message = {"id": "", "command": command, "data": data, "seq": 0, "t": 0}
    try:
        await send({"type": "websocket.send", "text": json.dumps(message), "bytes": None})
    except (OSError, RuntimeError) as error:  # it has gone
        log.debug("a browser was not told: %s", error)


async def care_for_ever() -> None:
    """Runs until it is cancelled; a step that fails is tried again."""
    while True:
        await asyncio.sleep(EVERY_S)
        try:
            watchmen.keep_to(await sync_to_async(ready_sessions)())
            soon = await sync_to_async(care)(attendance.take_used())
            text = await sync_to_async(drain.text)()
            await pages.tell(text)
            await attendance.tell(text)
            for session_id, minutes in soon.items():
                await attendance.warn(
                    session_id,
                    f"Nobody uses this session. It ends in {minutes} min; do something to keep it.",
                )
        except Exception:
            log.exception("the sessions were not looked after")


def care(used: dict[UUID, float]) -> dict[UUID, int]:
    """One round; returns the sessions that end soon, and in how many minutes."""
    now = timezone.now()
    for session_id, seconds in used.items():
        Session.objects.filter(id=session_id).update(used_at=now - timedelta(seconds=seconds))
    for session in ready_sessions():
        actions.refresh(session)
    soon = end_idle()
    actions.start_queued()
    return soon


def ready_sessions() -> list[Session]:
    """Those whose executors are to answer."""
    return list(Session.objects.filter(state=SessionState.READY))


def end_idle() -> dict[UUID, int]:
    """Ends what nobody used for too long; returns what ends soon, and in how many minutes."""
    limit = timedelta(minutes=environment().session_idle_minutes)
    soon: dict[UUID, int] = {}
    if not limit:
        return soon
    now = timezone.now()
    for session in Session.objects.filter(state=SessionState.READY, used_at__lt=now - limit + WARNING):
        left = limit - (now - (session.used_at or now))
        if left <= timedelta(0):
            log.info("session %s is idle and is ended", session.id)
            actions.end_session(session, "It was ended since nobody used it.")
        else:
            soon[session.id] = max(1, round(left.total_seconds() / 60))
    return soon
