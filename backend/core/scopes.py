"""Functions that read the ASGI scope of a request or a socket, before Django sees it."""

from __future__ import annotations

from http.cookies import CookieError, SimpleCookie
from typing import TYPE_CHECKING, Final

from backend.config.environment import environment
from backend.core import guard

if TYPE_CHECKING:
    from collections.abc import Mapping

    from asgiref.typing import HTTPScope, WebSocketScope

API: Final = ("/api/", "/tree_api/")
"""Where programs ask: the REST API, and JdeRobot's API of 2024."""


def headers_of(scope: HTTPScope | WebSocketScope) -> dict[str, str]:
    """Returns the headers by their names in lower case."""
    return {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]}


def cookies_of(header: str) -> dict[str, str]:
    """Returns the cookies of a `Cookie` header; an empty dict if it is malformed."""
    try:
        return {name: morsel.value for name, morsel in SimpleCookie(header).items()}
    except CookieError:
        return {}


def scheme_of(scope: HTTPScope | WebSocketScope, headers: Mapping[str, str]) -> str:
    """Returns `http` or `https`: the scheme that a trusted proxy reports, or that of the connection."""
    told = headers.get("x-forwarded-proto", "") if environment().proxy_hops else ""
    scheme = told or scope.get("scheme", "http")
    return "https" if scheme in {"https", "wss"} else "http"


def facts_of(scope: HTTPScope | WebSocketScope) -> guard.Facts:
    """Returns the facts that the guard needs."""
    headers = headers_of(scope)
    kind, _, bearer = headers.get("authorization", "").partition(" ")
    host = headers.get("host", "")
    return guard.Facts(
        method=scope.get("method", "GET"),  # type: ignore[arg-type] # a socket has none
        host=host,
        schemes=guard.schemes_of(host, scheme_of(scope, headers)),
        origin=headers.get("origin"),
        fetch_site=headers.get("sec-fetch-site"),
        cookie=cookies_of(headers.get("cookie", "")).get(guard.cookie_name(host)),
        bearer=bearer if kind.lower() == "bearer" else None,
        socket=scope["type"] == "websocket",
    )
