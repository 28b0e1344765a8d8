"""For whom a request or a socket takes something of which there is not enough for everybody.

Nothing is looked up for it, since it is asked before anything is known: a user is one whose session this
server has read before. All others, whatever cookies they show, count as one behind each address.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from backend.accounts.identity import last_seen
from backend.core.clients import address_of, stranger
from backend.core.scopes import cookies_of, headers_of

if TYPE_CHECKING:
    from asgiref.typing import HTTPScope, WebSocketScope


def user_owner(user_id: int) -> str:
    """Names a user as the owner of what they use."""
    return f"user {user_id}"


def owner_of(scope: HTTPScope | WebSocketScope) -> str:
    """The user, or the address."""
    headers = headers_of(scope)
    user = last_seen(cookies_of(headers.get("cookie", "")))
    if user is not None:
        return user_owner(user)
    client = scope.get("client")
    return stranger(address_of(client[0] if client else None, headers))
