"""The ASGI application: Django for HTTP, the routes of sockets, and the start and end of the server."""

from __future__ import annotations

import asyncio
import os
from typing import TYPE_CHECKING, Final

import django

if TYPE_CHECKING:
    from asgiref.typing import ASGI3Application, ASGIReceiveCallable, ASGISendCallable, Scope, WebSocketScope

os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
django.setup()

from channels.db import database_sync_to_async  # noqa: E402 - Django must be set up first
from channels.routing import ProtocolTypeRouter  # noqa: E402

from backend.config.probes import probed  # noqa: E402
from backend.core import notify  # noqa: E402
from backend.core.connection_costs import LARGEST_MESSAGE  # noqa: E402
from backend.core.limits import LIMITS  # noqa: E402
from backend.core.processes.siblings import beat_for_ever, siblings  # noqa: E402
from backend.core.tasks import ended  # noqa: E402
from backend.ingress.bodies import Upload  # noqa: E402
from backend.ingress.handler import ThreadedHandler  # noqa: E402
from backend.ingress.sockets import Route, serve  # noqa: E402
from backend.language import consumers as language  # noqa: E402
from backend.projects.api import consumers as projects  # noqa: E402
from backend.projects.api.notices import watch_revisions  # noqa: E402
from backend.projects.storage.usage import room_for_archive  # noqa: E402
from backend.sessions import consumers as sessions  # noqa: E402
from backend.sessions.lifecycle.writes import end_all_sessions  # noqa: E402
from backend.sessions.maintenance import begin, care_for_ever  # noqa: E402


async def lifespan(scope: Scope, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:
    """Cleans up after a killed server, maintains sessions while it runs, and ends them when it stops."""
    tasks: list[asyncio.Task[None]] = []
    while True:
        message = await receive()
        if message["type"] == "lifespan.startup":
            notify.serve(asyncio.get_running_loop())
            await database_sync_to_async(begin)()
            tasks.append(asyncio.create_task(care_for_ever()))
            if siblings.family is not None:
                tasks.append(asyncio.create_task(beat_for_ever(requests.threads)))
            await send({"type": "lifespan.startup.complete"})
        elif message["type"] == "lifespan.shutdown":
            await ended(*tasks)
            await database_sync_to_async(end_all_sessions)()
            notify.serve(None)
            await send({"type": "lifespan.shutdown.complete"})
            return


IMPORT: Final = "/api/v1/projects/import"
IMPORT_PART: Final = "/api/v1/projects/[0-9a-f-]{36}/imports(/inspect)?"

watch_revisions()
routes: Final = {
    projects.ADDRESS: Route(projects.serve_notices, projects.may_read),
    language.ADDRESS: Route(language.serve_language, projects.may_write, language.MAX_MESSAGE_BYTES),
    sessions.ADDRESS: Route(sessions.relay, sessions.may_use, LARGEST_MESSAGE, as_bytes=True),
}


async def sockets(scope: WebSocketScope, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:
    """Serves every websocket."""
    await serve(routes, scope, receive, send)


requests: Final = ThreadedHandler(
    Upload(IMPORT, room_for_archive), Upload(IMPORT_PART, lambda _: LIMITS["import_upload_bytes"])
)
application: ASGI3Application = probed(
    ProtocolTypeRouter({"http": requests, "websocket": sockets, "lifespan": lifespan}), requests.threads
)
