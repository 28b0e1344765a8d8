"""The socket that notifies an open project of its new revisions."""

from __future__ import annotations

import asyncio
import json
import re
from typing import TYPE_CHECKING, Any, Final
from uuid import UUID

from channels.db import database_sync_to_async

from backend.core.problems import NotFoundError
from backend.core.tasks import ended
from backend.ingress.sockets import ID, POLICY_VIOLATION, Call, Closed
from backend.projects.api.notices import notices_of
from backend.projects.api.open_pages import pages
from backend.projects.storage import queries
from backend.projects.storage.access import Need

if TYPE_CHECKING:
    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable

    from backend.accounts.models import User

ADDRESS: Final = re.compile(rf"^/ws/projects/{ID}/notices$")
NO_SUCH_PROJECT: Final = 4404


def may_read(project_id: UUID, user: User) -> None:
    """Raises a StudioError when the user may not open the project."""
    queries.project(project_id, user=user, need=Need.READ)


def may_write(project_id: UUID, user: User) -> None:
    """Raises a StudioError when the user may not change the project."""
    queries.project(project_id, user=user, need=Need.WRITE)


async def serve_notices(call: Call, receive: ASGIReceiveCallable, send: ASGISendCallable) -> Closed | None:
    """Sends `{"type": "revision", "revision", "author", "message"}`.

    The newest revision is sent immediately, then each new one.

    The messages `{"type": "server", "text"}` between them are notices to all users; an empty text ends the
    notice.
    """
    project_id = UUID(call.address[1])
    async with notices_of(project_id) as following:
        try:
            project = await database_sync_to_async(
                lambda: queries.project(project_id, user=call.user, need=Need.READ)
            )()
        except NotFoundError:
            return Closed(NO_SUCH_PROJECT, "There is no such project.")
        await _tell(send, {"type": "revision", "revision": project.revision, "author": "", "message": ""})
        pages.join(send)
        telling = asyncio.create_task(_relay(following, send))
        leaving = asyncio.create_task(_until_left(receive))
        try:
            done, _ = await asyncio.wait((telling, leaving), return_when=asyncio.FIRST_COMPLETED)
            return leaving.result() if leaving in done else None
        finally:
            pages.leave(send)
            await ended(telling, leaving)


async def _relay(following: Any, send: ASGISendCallable) -> None:
    while True:
        await _tell(send, await following())


async def _tell(send: ASGISendCallable, notice: dict[str, Any]) -> None:
    await send({"type": "websocket.send", "text": json.dumps(notice), "bytes": None})


async def _until_left(receive: ASGIReceiveCallable) -> Closed | None:
    """Waits until the page leaves (None) or sends a message.

    A message is refused, since pages send none on this socket.
    """
    if (await receive())["type"] == "websocket.disconnect":
        return None
    return Closed(POLICY_VIOLATION, "This socket accepts no messages.")
