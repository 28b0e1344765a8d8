"""The user of a client: the web server, which knows them, names them in a header of the socket that it opens.

A page cannot set headers of a websocket, and a program that can has the token of the manager. The other end
is `backend.sessions.manager_socket`.
"""

from __future__ import annotations

from typing import Final
from urllib.parse import unquote

__all__ = ["USER_HEADER", "user_of"]

USER_HEADER: Final = "X-BT-Studio-User"
MOST_CHARACTERS: Final = 150


def user_of(header: str | None) -> str | None:
    """Returns the name in a header, which has it in percent-encoding; None where there is no header."""
    return None if header is None else unquote(header, errors="replace")[:MOST_CHARACTERS]
