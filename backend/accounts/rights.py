"""Announces that a user's rights may have become fewer, so that open sockets check them again.

A websocket is checked when it opens. A user who is later removed from a project, signs out or is deactivated
must not receive more. So every open socket follows these notices, and repeats the usual check of rights.
Notices may be lost, and the command line cannot send them; therefore sockets also check every `RECHECK_S`.
"""

from __future__ import annotations

from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Any, Final

from channels.layers import get_channel_layer
from django.db import transaction
from django.dispatch import Signal

from backend.config.environment import environment
from backend.core.notify import tell

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable
    from uuid import UUID

GROUP: Final = "rights"
RECHECK_S: Final = 60.0
SETTLE_S: Final = 0.3
"""Seconds between a notice and the check. At a sign-out the notice comes before the session is deleted."""

lessened = Signal()
"""The signal of fewer rights, sent after the commit with `user_id` and `project_id`, one of which is None."""


def lessen(*, user_id: int | None = None, project_id: UUID | None = None) -> None:
    """Sends a notice for one user, or for everybody in one project, after the transaction."""
    if environment().is_team:
        # Robust: a notice that cannot be sent must not make the committed write look as if it had failed.
        transaction.on_commit(lambda: _tell(user_id, project_id), robust=True)


def _tell(user_id: int | None, project_id: UUID | None) -> None:
    lessened.send_robust(None, user_id=user_id, project_id=project_id)
    tell(GROUP, {"type": GROUP, "user_id": user_id})


@asynccontextmanager
async def notices() -> AsyncIterator[Callable[[], Awaitable[dict[str, Any]]]]:
    """Yields a function that waits for the next notice, whose `user_id` is None if it may concern all."""
    layer = get_channel_layer()
    channel = await layer.new_channel()
    await layer.group_add(GROUP, channel)
    try:
        yield lambda: layer.receive(channel)
    finally:
        await layer.group_discard(GROUP, channel)
