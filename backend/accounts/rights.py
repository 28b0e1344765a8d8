"""Announces that a user may have lost rights, so that open sockets check them again.

A websocket is checked when it opens. A user who later is removed from a project, signs out, or is deactivated
must receive no more messages. So every open socket follows these notices, and repeats the usual check of
rights. Notices may be lost, and the command line cannot send them; therefore sockets also check every
`RECHECK_S`.
"""

from __future__ import annotations

import asyncio
import logging
from contextlib import AsyncExitStack, asynccontextmanager
from typing import TYPE_CHECKING, Any, Final

from django.db import transaction
from django.dispatch import Signal

from backend.config.environment import environment
from backend.core.notify import NoNoticesError, following, tell

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable
    from uuid import UUID

log = logging.getLogger(__name__)

GROUP: Final = "rights"
RECHECK_S: Final = 60.0
SETTLE_S: Final = 0.3
"""Seconds between a notice and the check.

When a user signs out, the notice comes before the session is deleted.
"""

lessened = Signal()
"""Sent after a commit that may have removed rights, with `user_id` and `project_id`; one of them is None."""


def lessen(*, user_id: int | None = None, project_id: UUID | None = None) -> None:
    """Sends a notice for one user, or for all users of one project, after the transaction."""
    if environment().is_team:
        # With `robust`, a notice that cannot be sent does not make the committed write look as if it had
        # failed.
        transaction.on_commit(lambda: _tell(user_id, project_id), robust=True)


def _tell(user_id: int | None, project_id: UUID | None) -> None:
    lessened.send_robust(None, user_id=user_id, project_id=project_id)
    tell(GROUP, {"type": GROUP, "user_id": user_id})


@asynccontextmanager
async def notices() -> AsyncIterator[Callable[[], Awaitable[dict[str, Any]]]]:
    """Yields a function that waits for the next notice.

    If the notice may concern all users, its `user_id` is None. While Redis does not answer there are none,
    and a socket that opens is checked every `RECHECK_S` alone.
    """
    async with AsyncExitStack() as stack:
        try:
            next_notice = await stack.enter_async_context(following(GROUP))
        except NoNoticesError as error:
            log.warning("%s", error)
            next_notice = _never
        yield next_notice


async def _never() -> dict[str, Any]:
    return await asyncio.Future()
