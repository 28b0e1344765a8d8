"""Checks every websocket and passes it to its app.

Apps register their sockets in `routes` of `backend.config.asgi`. A route has a pattern of the path, a
coroutine that serves the accepted socket, and a check of the user's right, which is repeated while the socket
is open.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import re  # noqa: TC003
from collections import Counter
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, NamedTuple
from uuid import UUID

from channels.db import database_sync_to_async
from django.db import InterfaceError, OperationalError

from backend.accounts import rights
from backend.accounts.identity import identify
from backend.config.environment import environment
from backend.core import guard
from backend.core.connection_costs import known
from backend.core.notify import NoNoticesError
from backend.core.problems import StudioError
from backend.core.scopes import cookies_of, facts_of, headers_of
from backend.core.tasks import ended
from backend.core.websocket import AS_BYTES, MOST_BYTES, SMALL_BYTES
from backend.ingress.owners import owner_of
from backend.ingress.turns import turns

if TYPE_CHECKING:
    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable, WebSocketScope

    from backend.accounts.models import User

log = logging.getLogger(__name__)
DatabaseUnreachable: Final = (OperationalError, InterfaceError)

PROTOCOL: Final = "bt-studio.v1"
ID: Final = r"([0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12})"
"""The pattern of a project's or session's id in a path."""
POLICY_VIOLATION: Final = 1008
TRY_AGAIN_LATER: Final = 1013
SIGNED_OUT: Final = 4401
FORBIDDEN: Final = 4404
_REASON_BYTES: Final = 120  # a close frame holds 123
OF_A_USER: Final = 100
"""The number of sockets that one user may have open; each page has up to four."""
OF_AN_ADDRESS: Final = 500
"""The number of sockets that all guests and unidentified clients with one address may have open."""
HANDSHAKE_S: Final = 0.0035
"""Processor time in seconds to open a socket, to look up its user, to watch their right and to close it.

As measured: `tests/benchmarks/user_floods.py`, kind `sockets`.
"""
AT_THE_DOOR: Final = 2
"""The number of sockets of one owner whose users are looked up at the same time; the others wait."""


@dataclass(frozen=True, slots=True)
class Closed:
    """The code and reason with which one side closed its socket."""

    code: int
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Call:
    """The request of a socket: the matched path, the user, and the query string."""

    address: re.Match[str]
    user: User
    query: str


Handler = Callable[[Call, "ASGIReceiveCallable", "ASGISendCallable"], Awaitable["Closed | None"]]


class Route(NamedTuple):
    """The function that serves a socket, and the right that the user needs.

    `may` receives the id in the path and the user; it raises a StudioError if the user lacks the right. The
    largest message of a user has `most_bytes`; that of a guest is much smaller. With `as_bytes`, the handler
    gets texts as bytes that it passes on (`backend.core.websocket.IS_TEXT`).
    """

    handler: Handler
    may: Callable[[UUID, User], object]
    most_bytes: int = SMALL_BYTES
    as_bytes: bool = False


class Crowd:
    """Limits the open sockets of each owner, and the number of them that are being opened."""

    def __init__(self) -> None:
        self.sockets: Counter[str] = Counter()
        self._doors: dict[str, asyncio.Semaphore] = {}

    @contextlib.asynccontextmanager
    async def place(self, owner: str) -> AsyncIterator[asyncio.Semaphore | None]:
        """Counts a socket while it is open.

        Yields the owner's semaphore, or None if the owner has too many sockets.
        """
        most = OF_AN_ADDRESS if owner.startswith("address") else OF_A_USER
        if self.sockets[owner] >= most and environment().is_team:
            yield None
            return
        self.sockets[owner] += 1
        try:
            yield self._doors.setdefault(owner, asyncio.Semaphore(AT_THE_DOOR))
        finally:
            self.sockets[owner] -= 1
            if not self.sockets[owner]:
                del self.sockets[owner], self._doors[owner]


_crowd: Final = Crowd()


def refusal(scope: WebSocketScope) -> guard.Refusal | None:
    """Returns the reason to refuse the socket, by the same rules as for pages; None if it is accepted."""
    return guard.check(facts_of(scope))


async def serve(
    routes: Mapping[re.Pattern[str], Route],
    scope: WebSocketScope,
    receive: ASGIReceiveCallable,
    send: ASGISendCallable,
) -> None:
    """Serves a socket whose path has a route; refuses all others."""
    await receive()  # websocket.connect
    found = _route(routes, scope["path"])
    owner = owner_of(scope)
    known(scope, owner)
    async with _crowd.place(owner) as door:
        # The handler checks whether this user may access the project or session that the path names.
        user = None
        if found is not None and door is not None and refusal(scope) is None:
            async with door, turns.turn(owner):
                user = await _user(scope)
                turns.spend(owner, HANDSHAKE_S)
        if found is None or user is None:
            # If the socket is closed before it is accepted, uvicorn answers the handshake with 403.
            await send({"type": "websocket.close", "code": POLICY_VIOLATION, "reason": ""})
            return
        await _serve(*found, user, scope, receive, send)


async def _serve(  # noqa: PLR0913, PLR0917 - a socket
    address: re.Match[str],
    route: Route,
    user: User,
    scope: WebSocketScope,
    receive: ASGIReceiveCallable,
    send: ASGISendCallable,
) -> None:
    offered = list(scope.get("subprotocols") or [])
    subprotocol = PROTOCOL if PROTOCOL in offered else None
    most = SMALL_BYTES if user.is_guest else route.most_bytes
    accept: Any = {"subprotocol": subprotocol, "headers": [], MOST_BYTES: most, AS_BYTES: route.as_bytes}
    await send({"type": "websocket.accept"} | accept)
    call = Call(address, user, scope["query_string"].decode("latin-1"))
    try:
        if environment().is_team:
            closed = await _while_allowed(route, call, scope, receive, send)
        else:
            closed = await route.handler(call, receive, send)
    except StudioError as error:
        closed = Closed(FORBIDDEN, error.detail)
    except NoNoticesError as error:
        log.warning("%s", error)
        closed = Closed(TRY_AGAIN_LATER, "The server's notices do not work now. Try again in a moment.")
    except DatabaseUnreachable as error:
        log.warning("%s", error)
        closed = Closed(TRY_AGAIN_LATER, "The database does not answer. Try again in a moment.")
    if closed is not None:
        with contextlib.suppress(OSError, RuntimeError):
            await send({"type": "websocket.close", "code": closed.code, "reason": short(closed.reason)})


async def _while_allowed(
    route: Route, call: Call, scope: WebSocketScope, receive: ASGIReceiveCallable, send: ASGISendCallable
) -> Closed | None:
    """Serves until the socket ends, or until its user loses the right to it."""
    serving = asyncio.ensure_future(route.handler(call, receive, send))
    watching = asyncio.create_task(_until_forbidden(route, call, scope))
    try:
        done, _ = await asyncio.wait((serving, watching), return_when=asyncio.FIRST_COMPLETED)
        return (serving if serving in done else watching).result()
    finally:
        await ended(serving, watching)


async def _until_forbidden(route: Route, call: Call, scope: WebSocketScope) -> Closed:
    async with rights.notices() as next_notice:
        while True:
            notice: Mapping[str, object] = {}
            with contextlib.suppress(TimeoutError):
                notice = await asyncio.wait_for(next_notice(), rights.RECHECK_S)
            if notice.get("user_id") not in {None, call.user.pk}:
                continue
            await asyncio.sleep(rights.SETTLE_S)
            try:
                user = await _user(scope)
                if user is None or user.pk != call.user.pk:
                    return Closed(SIGNED_OUT, "You are signed out.")
                await database_sync_to_async(route.may)(UUID(call.address[1]), user)
            except StudioError as error:
                return Closed(FORBIDDEN, error.detail)
            except DatabaseUnreachable as error:  # robots continue while the database is away
                log.warning("the rights of a socket are not checked now: %s", error)


def _route(routes: Mapping[re.Pattern[str], Route], path: str) -> tuple[re.Match[str], Route] | None:
    matches = ((pattern.match(path), route) for pattern, route in routes.items())
    return next(((match, route) for match, route in matches if match), None)


async def _user(scope: WebSocketScope) -> User | None:
    cookies = cookies_of(headers_of(scope).get("cookie", ""))
    user: User | None = await database_sync_to_async(identify)(cookies)
    return user


def short(reason: str) -> str:
    """Shortens a reason so that it fits into a close frame."""
    first = reason.splitlines()[0] if reason else ""
    return first.encode()[:_REASON_BYTES].decode(errors="ignore")
