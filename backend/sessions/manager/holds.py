"""Asks executors whether a debugger holds their tree: a hold counts as use, until the executor ends it."""

from __future__ import annotations

import http.client
import json
from typing import TYPE_CHECKING, Final

from backend.sessions.lifecycle import writes
from backend.sessions.manager.address import http_connection

if TYPE_CHECKING:
    from backend.sessions.models import Session

HELD: Final = "held"
ANSWER_S: Final = 1.0
MOST_BYTES: Final = 4096


def is_held(session: Session) -> bool:
    """Returns whether the tree of a session is held; False if its executor does not answer in time."""
    connection = http_connection(session.address, ANSWER_S)
    try:
        connection.request(
            "GET", "/health", headers={"Authorization": f"Bearer {writes.manager_token(session)}"}
        )
        with connection.getresponse() as answer:
            health = json.loads(answer.read(MOST_BYTES))
    except (OSError, http.client.HTTPException, ValueError):
        return False
    finally:
        connection.close()
    return isinstance(health, dict) and health.get("state") == HELD
