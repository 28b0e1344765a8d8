"""Connects the web server to a user's tools. Each user has a container that reads files for the editor.

The container runs `executor.tools`; the launcher of the sessions starts it. Its id and token are derived from
the user, so that every web server finds the same container, and nothing must be stored.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import time
from typing import TYPE_CHECKING, Any, Final
from uuid import UUID, uuid5

from asgiref.sync import sync_to_async
from django.conf import settings
from websockets.exceptions import InvalidHandshake, WebSocketException

from backend.config.environment import environment
from backend.language.errors import CheckerUnavailableError, UnavailableError
from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.lifecycle.writes import launcher
from backend.sessions.manager.address import open_socket, open_sync_socket

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from websockets.asyncio.client import ClientConnection

    from backend.accounts.models import User
    from backend.core.processes.stops import Stop

_NAMESPACE: Final = UUID("1d0a2f0e-6f0b-5c5e-9b57-0f6a1a8f6c11")
ANSWER_S: Final = 15.0
TESTS_S: Final = 90.0
UPLOADS_S: Final = 100.0
# If the tools are just ending, the next attempt finds them ended and starts them again.
_ATTEMPTS: Final = 3
_PAUSE_S: Final = 0.3
_MAX_BYTES: Final = 16 << 20
_MAX_MADE_BYTES: Final = 64 << 20
addresses: Final[dict[str, str]] = {}
"""The addresses of opened tools, by their ids."""


def tools_id(user: User) -> str:
    """Returns the id of a user's tools."""
    return str(uuid5(_NAMESPACE, str(user.pk)))


def token(made_id: str) -> str:
    """Returns the secret that the web server and the tools share."""
    return hmac.new(settings.SECRET_KEY.encode(), f"tools {made_id}".encode(), hashlib.sha256).hexdigest()


def address_of(made_id: str, *, is_known_good: bool) -> str:
    """Returns the address of the tools. Calls the launcher, unless the known address can still be used."""
    if not is_known_good or made_id not in addresses:
        limit_s = environment().session_start_timeout_s
        addresses[made_id] = launcher().open_tools(made_id, token(made_id), timeout_s=limit_s)
    return addresses[made_id]


def _options(made_id: str) -> dict[str, Any]:
    headers = {"Authorization": f"Bearer {token(made_id)}"}
    return {
        "additional_headers": headers,
        "compression": None,
        "max_size": _MAX_BYTES,
        "open_timeout": ANSWER_S,
    }


async def open_editor(user: User) -> ClientConnection:
    """Opens the socket of one editor.

    Raises:
        UnavailableError: the tools cannot be started, or do not answer.
    """
    made_id = tools_id(user)
    problem: Exception = TimeoutError()
    for attempt in range(_ATTEMPTS):
        try:
            find = sync_to_async(address_of, thread_sensitive=False)
            address = await find(made_id, is_known_good=attempt == 0)
            return await open_socket(address, "language", ping_interval=None, **_options(made_id))
        except HostFullError as error:
            raise UnavailableError("Too many people edit Python on this server just now.") from error
        except LaunchError as error:
            raise UnavailableError(f"The language server cannot be started: {error.detail}") from error
        except (OSError, InvalidHandshake) as error:
            problem = error
            await sync_to_async(time.sleep, thread_sensitive=False)(_PAUSE_S * attempt)
    raise UnavailableError("The language server does not answer.") from problem


def run_ruff(user: User, arguments: list[str], source: str) -> tuple[int | None, str]:
    """Runs ruff in a user's tools; returns its status (None after a timeout) and its output.

    Raises:
        CheckerUnavailableError: the tools cannot be started, or do not answer.
    """
    answer = json.loads(_ask(user, "ruff", json.dumps({"arguments": arguments, "source": source}), ANSWER_S))
    return answer["status"], answer["output"]


def run_behaviours(user: User, text: str, stop: Stop) -> str:
    """Runs behaviour tests in a user's tools; returns the answer of `executor.tools.behaviours`.

    Raises:
        CheckerUnavailableError: the tools cannot be started, or do not answer.
        StoppedError: the tests were ended before.
    """
    return _ask(user, "tests", text, TESTS_S, opened=stop.bind)


def run_upload(user: User, parts: Iterable[bytes], opened: Callable[[Callable[[], None]], None]) -> bytes:
    """Imports from an upload in a user's tools; returns the answer of `executor.uploads`.

    Args:
        user: the user.
        parts: the header, a line feed and the upload; they are sent one after the other, once.
        opened: is called with what ends the work, once the tools are reached.

    Raises:
        CheckerUnavailableError: the tools cannot be started, or do not answer.
    """
    return _ask(user, "uploads", parts, UPLOADS_S, most=_MAX_MADE_BYTES, opened=opened).encode()


def _ask(  # noqa: PLR0913 - one a limit
    user: User,
    what: str,
    text: str | Iterable[bytes],
    limit_s: float,
    *,
    most: int = _MAX_BYTES,
    opened: Callable[[Callable[[], None]], None] | None = None,
) -> str:
    """Sends a message to a user's tools, and returns their answer. What comes in parts is sent once."""
    made_id = tools_id(user)
    problem: Exception = TimeoutError()
    is_last = False
    for attempt in range(_ATTEMPTS):
        try:
            address = address_of(made_id, is_known_good=attempt == 0)
            with open_sync_socket(address, what, **_options(made_id) | {"max_size": most}) as socket:
                if opened is not None:
                    opened(socket.close)
                is_last = not isinstance(text, str)
                socket.send(text)
                answer = socket.recv(timeout=limit_s)
                return answer if isinstance(answer, str) else answer.decode()
        except LaunchError as error:
            raise CheckerUnavailableError(error.detail) from error
        except HostFullError as error:
            raise CheckerUnavailableError("Too many people edit Python on this server just now.") from error
        except (OSError, WebSocketException) as error:
            problem = error
            if is_last:
                break
            time.sleep(_PAUSE_S * attempt)
    raise CheckerUnavailableError("The user's tools do not answer.") from problem
