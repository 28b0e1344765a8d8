"""Relays the two sockets of a session unchanged between the browser and the manager.

Messages are neither parsed nor queued: in each direction one message is received and passed on before the
next one. So a slow browser slows down the socket of its manager. The manager knows which messages newer ones
replace, and then sends fewer. Frames never touch the channel layer. No socket can occupy the event loop, even
if it sends much.
"""

from __future__ import annotations

import asyncio
import logging
import re
from typing import TYPE_CHECKING, Any, Final
from uuid import UUID

from channels.db import database_sync_to_async
from websockets.exceptions import ConnectionClosed, InvalidHandshake

from backend.core.problems import NotFoundError
from backend.core.tasks import ended
from backend.core.websocket import IS_TEXT, READ_BYTES, read_at_most
from backend.ingress.owners import user_owner
from backend.ingress.sockets import ID, Call, Closed
from backend.ingress.turns import turns as shares
from backend.sessions import queries
from backend.sessions.choices import SessionState
from backend.sessions.lifecycle import writes
from backend.sessions.maintenance import attendance, say
from backend.sessions.manager.sockets import manager_socket
from backend.sessions.turns import turn_of
from backend.sessions.watch import watchmen, why

if TYPE_CHECKING:
    from collections.abc import Iterator

    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable
    from websockets.asyncio.client import ClientConnection

    from backend.accounts.models import User
    from backend.sessions.models import Session
    from backend.sessions.turns import Turn

log = logging.getLogger(__name__)

ADDRESS: Final = re.compile(rf"^/ws/sessions/{ID}/(control|stream)$")
PING: Final = re.compile(rb'"command"\s*:\s*"ping"')
LONGEST_PING: Final = 100
PART_BYTES: Final = 256 << 10
"""Bytes of one frame to a manager: a large message is sent in several, and never copied as a whole."""
MESSAGES_IN_TURN: Final = 4
MESSAGE_S: Final = 0.00015
BYTE_S: Final = 2e-9
"""Event-loop time in seconds for an executor's message (`MESSAGE_S`) and for each of its bytes."""
POLL_S: Final = 0.03
QUEUE_POLL_S: Final = 1.0
# A container with many processes ends seconds after its sockets, and later on a busy host.
LOST_POLL_S: Final = 0.1
LOST_POLLS: Final = 150

GOING_AWAY: Final = 1001
NO_SUCH_SESSION: Final = 4404
EXECUTOR_FAILED: Final = 4503
EXECUTOR_SILENT: Final = 4504


def may_use(session_id: UUID, user: User) -> None:
    """Raises a StudioError if the user may no longer run the session's project."""
    writes.require_right(queries.session(session_id, user=user))


async def relay(call: Call, receive: ASGIReceiveCallable, send: ASGISendCallable) -> Closed | None:
    """Relays one socket until either side ends."""
    if call.user.is_guest:
        return Closed(NO_SUCH_SESSION, "There is no such session.")
    return await _serve(UUID(call.address[1]), call.user, call.address[2], call.query, receive, send)


async def _serve(  # noqa: PLR0913, PLR0917 - both ends of a relay
    session_id: UUID,
    user: User,
    channel: str,
    query: str,
    receive: ASGIReceiveCallable,
    send: ASGISendCallable,
) -> Closed | None:
    """Relays until either side ends.

    Returns the close message for the browser, or None if the browser has left.
    """
    is_control = channel == "control"
    try:
        session = await _when_ready(session_id, user, send if is_control else None)
    except NotFoundError as error:
        return Closed(NO_SUCH_SESSION, error.detail)
    if session.state != SessionState.READY:
        return _ended(session)
    noted = _noting(session_id, receive) if is_control else receive
    try:
        with watchmen.beside_page(session):
            async with manager_socket(session, channel + (f"?{query}" if query else ""), user) as manager:
                if is_control:
                    read_at_most(manager.transport, READ_BYTES)
                    attendance.join(session_id, send)
                closed = await _relay(manager, noted, send, user_owner(user.pk))
    except (OSError, InvalidHandshake, TimeoutError) as error:
        log.warning("session %s: no %s socket: %s", session_id, channel, error)
        closed = Closed(EXECUTOR_FAILED, "The session does not answer.")
    finally:
        attendance.leave(session_id, send)
    if closed is None:
        return None
    return await _explained(session, closed)


def _noting(session_id: UUID, receive: ASGIReceiveCallable) -> ASGIReceiveCallable:
    """Returns a `receive` that also notes that the session is used.

    Each message of the browser counts, except pings.
    """

    async def receive_and_note() -> Any:
        message: Any = await receive()
        if not _is_ping(message.get("bytes") or b""):
            attendance.use(session_id)
        return message

    return receive_and_note


def _is_ping(text: bytes) -> bool:
    """Returns whether the request only checks whether its session hangs; pages send it without a user."""
    return len(text) <= LONGEST_PING and PING.search(text) is not None


async def _explained(session: Session, closed: Closed) -> Closed:
    """Adds the reason why an executor was lost; its process ends a moment after its sockets."""
    for _ in range(LOST_POLLS if closed.code == EXECUTOR_FAILED else 1):
        session = await database_sync_to_async(writes.seen_again)(session)
        if session.state != SessionState.READY:
            return _ended(session)
        await asyncio.sleep(LOST_POLL_S)
    return closed


def _ended(session: Session) -> Closed:
    """Returns the code and reason that close a page's socket at the end of its session.

    A silent executor has a special code.
    """
    code = EXECUTOR_SILENT if session.error == why() else EXECUTOR_FAILED
    return Closed(code, session.error or "The session has ended.")


async def _when_ready(session_id: UUID, user: User, send: ASGISendCallable | None) -> Session:
    """Waits until the session neither waits nor starts, and returns it.

    A waiting browser is sent how many go before it.
    """
    find = database_sync_to_async(lambda: queries.session(session_id, user=user))
    told: Turn | None = None
    # Another web server may be starting it: so this polls the database and waits for no local event.
    session: Session = await find()
    while session.state in {SessionState.QUEUED, SessionState.STARTING}:
        is_queued = session.state == SessionState.QUEUED
        turn = await database_sync_to_async(turn_of)(session) if is_queued else None
        if turn != told and send is not None:
            await say(send, "queued", {"before": None, "is_own": False} if turn is None else turn._asdict())
        told = turn
        await asyncio.sleep(QUEUE_POLL_S if is_queued else POLL_S)
        session = await find()
    return session


async def _relay(
    manager: ClientConnection, receive: ASGIReceiveCallable, send: ASGISendCallable, owner: str
) -> Closed | None:
    up = asyncio.create_task(_browser_to_manager(receive, manager))
    down = asyncio.create_task(_manager_to_browser(manager, send, owner))
    try:
        done, _ = await asyncio.wait((up, down), return_when=asyncio.FIRST_COMPLETED)
        first = up if up in done else down
        return await first
    finally:
        await ended(up, down)


async def _browser_to_manager(receive: ASGIReceiveCallable, manager: ClientConnection) -> Closed | None:
    turns = _Turns()
    while True:
        message: Any = await receive()
        if message["type"] == "websocket.disconnect":
            code = message.get("code") or 1000
            await manager.close(code if code in {1000, 1001} or 3000 <= code < 5000 else GOING_AWAY)
            return None
        try:
            await manager.send(_parts(message["bytes"]), text=message.get(IS_TEXT, False))
        except ConnectionClosed as error:
            return _closed_by(error)
        await turns.next()


def _parts(data: bytes) -> bytes | Iterator[memoryview]:
    """Returns a message for a manager: as it is, or the parts of a large one."""
    if len(data) <= PART_BYTES:
        return data
    view = memoryview(data)
    return (view[at : at + PART_BYTES] for at in range(0, len(view), PART_BYTES))


async def _manager_to_browser(manager: ClientConnection, send: ASGISendCallable, owner: str) -> Closed | None:
    """Passes on messages of the executor. It follows the pace of the browser, and the share of its user."""
    turns = _Turns()
    try:
        while True:
            message = await manager.recv()
            if isinstance(message, str):
                await send({"type": "websocket.send", "text": message, "bytes": None})
            else:
                await send({"type": "websocket.send", "bytes": message, "text": None})
            shares.spend(owner, MESSAGE_S + BYTE_S * len(message))
            await shares.rest(owner)
            await turns.next()
    except ConnectionClosed as error:
        return _closed_by(error)
    except OSError:
        return None  # the browser has disconnected


class _Turns:
    """Yields to other sockets after some messages.

    Receiving a message that has already arrived does not wait.
    """

    def __init__(self) -> None:
        self._messages = 0

    async def next(self) -> None:
        """Gives other sockets time to run; must be called after each message."""
        self._messages += 1
        if self._messages % MESSAGES_IN_TURN == 0:
            await asyncio.sleep(0)


def _closed_by(error: ConnectionClosed) -> Closed:
    if error.rcvd is None or error.rcvd.code in {1005, 1006}:
        return Closed(EXECUTOR_FAILED, "The connection to the session was lost.")
    return Closed(error.rcvd.code, error.rcvd.reason)
