"""What every websocket passes before an app serves it, and which app serves it.

Apps register their sockets in `routes` of `backend.config.asgi`: a pattern of the path, and a coroutine
that is called once the guard has let the socket pass and it is accepted.
"""

from __future__ import annotations

import contextlib
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from asgiref.sync import sync_to_async

from backend.accounts.identity import identify
from backend.config import guard
from backend.config.middleware import cookies_of

if TYPE_CHECKING:
    import re

    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable, WebSocketScope

    from backend.accounts.models import User

POLICY_VIOLATION: Final = 1008
_REASON_BYTES: Final = 120  # a close frame holds 123


@dataclass(frozen=True, slots=True)
class Closed:
    """How one side ended its socket."""

    code: int
    reason: str = ""


Handler = Callable[
    ["re.Match[str]", "User", "ASGIReceiveCallable", "ASGISendCallable"], Awaitable["Closed | None"]
]


def _headers(scope: WebSocketScope) -> dict[str, str]:
    return {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]}


def refusal(scope: WebSocketScope) -> guard.Refusal | None:
    """Why the socket goes no further, by the same rules as for pages."""
    headers = _headers(scope)
    scheme, _, bearer = headers.get("authorization", "").partition(" ")
    host = headers.get("host", "")
    facts = guard.Facts(
        method="GET",
        host=host,
        origin=headers.get("origin"),
        cookie=cookies_of(headers.get("cookie", "")).get(guard.cookie_name(host)),
        bearer=bearer if scheme.lower() == "bearer" else None,
        socket=True,
    )
    return guard.check(facts)


async def serve(
    routes: Mapping[re.Pattern[str], Handler],
    scope: WebSocketScope,
    receive: ASGIReceiveCallable,
    send: ASGISendCallable,
) -> bool:
    """Serves a socket whose path is one of these; False when it is none, and nothing has been read."""
    for pattern, handler in routes.items():
        match = pattern.match(scope["path"])
        if match:
            await _serve(match, handler, scope, receive, send)
            return True
    return False


async def _serve(
    match: re.Match[str],
    handler: Handler,
    scope: WebSocketScope,
    receive: ASGIReceiveCallable,
    send: ASGISendCallable,
) -> None:
    await receive()  # websocket.connect
    refused = refusal(scope) is not None
    cookies = cookies_of(_headers(scope).get("cookie", ""))
    # Whether this user may see what the path names is for the handler to ask.
    user = None if refused else await sync_to_async(identify)(cookies)
    if user is None:
        # A close before the accept makes the server answer the handshake with 403.
        await send({"type": "websocket.close", "code": POLICY_VIOLATION, "reason": ""})
        return
    await send({"type": "websocket.accept", "subprotocol": None, "headers": []})
    closed = await handler(match, user, receive, send)
    if closed is not None:
        with contextlib.suppress(OSError, RuntimeError):
            await send({"type": "websocket.close", "code": closed.code, "reason": short(closed.reason)})


def short(reason: str) -> str:
    """What of a reason fits into a close frame."""
    first = reason.splitlines()[0] if reason else ""
    return first.encode()[:_REASON_BYTES].decode(errors="ignore")
