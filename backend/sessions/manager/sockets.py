"""Opens sockets to a session's manager."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final
from urllib.parse import quote

from backend.config.environment import environment
from backend.sessions.lifecycle import writes
from backend.sessions.manager.address import open_socket

if TYPE_CHECKING:
    from websockets.asyncio.client import connect

    from backend.accounts.models import User
    from backend.sessions.models import Session

MAX_MESSAGE_BYTES: Final = 64 * 1024 * 1024
QUEUED_MESSAGES: Final = 2
CLOSING_S: Final = 2
"""The time in which a manager has to answer the closing of a socket."""
USER_HEADER: Final = "X-BT-Studio-User"
"""Names the user to the manager (`executor.manager.identity`), in percent-encoding."""


def manager_socket(session: Session, target: str, user: User | None = None) -> connect:
    """Opens a socket to the manager of a session; with `user`, what a client does is done in their name."""
    headers = {"Authorization": f"Bearer {writes.manager_token(session)}"}
    if user is not None:
        headers[USER_HEADER] = quote(_name(user), safe="")
    return open_socket(
        session.address,
        target,
        additional_headers=headers,
        compression=None,
        max_size=MAX_MESSAGE_BYTES,
        max_queue=QUEUED_MESSAGES,
        ping_interval=None,
        close_timeout=CLOSING_S,
    )


def _name(user: User) -> str:
    """Returns the name that others see; without accounts nobody has one."""
    return (user.get_full_name() or user.username) if environment().is_team else ""
