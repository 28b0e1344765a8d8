"""The pages that have a project open through this server; they receive notices to all users."""

from __future__ import annotations

import json
import logging
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from asgiref.typing import ASGISendCallable

log = logging.getLogger(__name__)


class Pages:
    """The sockets of open projects, and the last notice that each received."""

    def __init__(self) -> None:
        self._told: dict[ASGISendCallable, str] = {}

    def join(self, send: ASGISendCallable) -> None:
        """Adds a page that opened a project."""
        self._told[send] = ""

    def leave(self, send: ASGISendCallable) -> None:
        """Removes a page."""
        self._told.pop(send, None)

    async def tell(self, text: str) -> None:
        """Sends a text to each page to which it was not the last text; an empty text ends the notice."""
        for send in [send for send, told in self._told.items() if told != text]:
            self._told[send] = text
            notice = json.dumps({"type": "server", "text": text})
            try:
                await send({"type": "websocket.send", "text": notice, "bytes": None})
            except (OSError, RuntimeError) as error:  # the page has closed
                log.debug("a page was not told: %s", error)


pages: Final = Pages()
