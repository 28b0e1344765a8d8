"""Owners: the users or addresses to whom the shared resources of requests and sockets are charged.

The owner must be known before the request is read, so the database is not queried. A user is recognized if
this process has read their session before. All others behind one address count as one owner, whatever cookies
they send.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from backend.accounts.identity import last_seen
from backend.core.clients import address_of, stranger
from backend.core.scopes import cookies_of, headers_of

if TYPE_CHECKING:
    from asgiref.typing import HTTPScope, WebSocketScope


def user_owner(user_id: int) -> str:
    """Returns the name of the owner for a user."""
    return f"user {user_id}"


def owner_of(scope: HTTPScope | WebSocketScope) -> str:
    """Returns the owner of a request or a socket: the user, otherwise the address."""
    headers = headers_of(scope)
    user = last_seen(cookies_of(headers.get("cookie", "")))
    if user is not None:
        return user_owner(user)
    client = scope.get("client")
    return stranger(address_of(client[0] if client else None, headers))
