"""Opens sockets to a session's manager."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from websockets.asyncio.client import connect, unix_connect

from backend.sessions import writes

if TYPE_CHECKING:
    from backend.sessions.models import Session

MAX_MESSAGE_BYTES: Final = 64 * 1024 * 1024
QUEUED_MESSAGES: Final = 2


def manager_socket(session: Session, target: str) -> connect:
    """Opens a socket to the manager of a session.

    Its address is `host:port`, or `unix:` with the path of a unix socket.
    """
    options: dict[str, Any] = {
        "additional_headers": {"Authorization": f"Bearer {writes.manager_token(session)}"},
        "compression": None,
        "max_size": MAX_MESSAGE_BYTES,
        "max_queue": QUEUED_MESSAGES,
        "ping_interval": None,
        "proxy": None,
        "close_timeout": 2,
    }
    kind, _, path = session.address.partition(":")
    if kind == "unix":
        return unix_connect(path, f"ws://localhost/{target}", **options)
    return connect(f"ws://{session.address}/{target}", **options)
