"""The requests that the web server may make, over a unix socket that only the web server sees.

Bodies are JSON objects with these fields:

    GET    /health                    200 when Docker answers
    GET    /sessions                  every executor
    POST   /sessions                  {session, token, domain_id, timeout_s}: starts an executor
    GET    /sessions/<id>             whether the executor runs
    DELETE /sessions/<id>?timeout_s=5 ends the executor
    POST   /tools                     {tools, token, timeout_s}: the path of a user's tools; starts them
"""

from __future__ import annotations

import json
import logging
import re
import socketserver
import threading
from http.server import BaseHTTPRequestHandler
from typing import TYPE_CHECKING, Any, Final
from urllib.parse import parse_qs, urlsplit

from backend.sessions.gate.doors import listen_at
from backend.sessions.keeper.errors import KeeperError

if TYPE_CHECKING:
    from pathlib import Path

    from backend.sessions.keeper.service import Keeper
    from backend.sessions.keeper.tools import ToolsKeeper

log = logging.getLogger(__name__)

SESSION_ID: Final = re.compile(r"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")
TOKEN: Final = re.compile(r"[0-9A-Za-z_-]{32,128}")
MAX_BODY_BYTES: Final = 4096
MAX_TIMEOUT_S: Final = 300.0
MAX_REQUESTS: Final = 128
"""Number of requests at the same time; each needs a thread and about four descriptors."""


class KeeperServer(socketserver.ThreadingUnixStreamServer):
    """Serves the keeper's requests at the path of a unix socket.

    Requests are limited, so that neither threads nor descriptors run out: a silent connection is closed after
    30 s, and a connection that arrives when all places are taken is closed immediately.
    """

    daemon_threads = True

    def __init__(self, path: Path, keeper: Keeper, tools: ToolsKeeper) -> None:
        super().__init__(str(path), _Handler, bind_and_activate=False)
        self.keeper = keeper
        self.tools = tools
        self._places = threading.BoundedSemaphore(MAX_REQUESTS)
        self.socket.close()
        self.socket = listen_at(path)

    def verify_request(self, *_: object) -> bool:
        """Returns whether one more request may be handled."""
        if self._places.acquire(blocking=False):
            return True
        log.warning("%d requests at once are too many", MAX_REQUESTS)
        return False

    def process_request(self, *request: Any) -> None:
        """Handles one request on its own thread."""
        try:
            super().process_request(*request)
        except BaseException:
            self._places.release()
            raise

    def process_request_thread(self, *request: Any) -> None:
        """Answers one request."""
        try:
            super().process_request_thread(*request)
        finally:
            self._places.release()


class _Handler(BaseHTTPRequestHandler):
    server: KeeperServer
    protocol_version = "HTTP/1.1"
    timeout = 30

    def do_GET(self) -> None:
        self._run(self._get)

    def do_POST(self) -> None:
        self._run(self._post)

    def do_DELETE(self) -> None:
        self._run(self._delete)

    def _get(self) -> tuple[int, object]:
        keeper = self.server.keeper
        if self.path == "/health":
            keeper.list()
            return 200, {"status": "ok"}
        if self.path == "/sessions":
            return 200, {"sessions": keeper.list()}
        return 200, keeper.look(self._session_id())

    def _post(self) -> tuple[int, object]:
        body = self._body()
        if self.path == "/tools":
            return self._post_tools(body)
        if self.path != "/sessions":
            raise KeeperError(404, "not_found", "There is no such address.")
        domain_id: Any = body.get("domain_id")
        is_valid = (
            type(domain_id) is int
            and 0 <= domain_id <= 101
            and _names(body, "session")
            and set(body) <= {"session", "token", "domain_id", "timeout_s"}
        )
        if not is_valid:
            raise KeeperError(400, "bad_request", "A start names session, token, domain_id and timeout_s.")
        return 201, self.server.keeper.start(
            body["session"], body["token"], domain_id, float(body.get("timeout_s", 30))
        )

    def _post_tools(self, body: dict[str, Any]) -> tuple[int, object]:
        if not _names(body, "tools") or not set(body) <= {"tools", "token", "timeout_s"}:
            raise KeeperError(400, "bad_request", "Asking for tools names tools, token and timeout_s.")
        timeout_s = float(body.get("timeout_s", 30))
        return 200, self.server.tools.open(body["tools"], body["token"], timeout_s)

    def _delete(self) -> tuple[int, object]:
        asked = parse_qs(urlsplit(self.path).query).get("timeout_s", ["5"])[0]
        try:
            timeout_s = min(max(float(asked), 1.0), MAX_TIMEOUT_S)
        except ValueError:
            raise KeeperError(400, "bad_request", "timeout_s is no number.") from None
        self.server.keeper.stop(self._session_id(), timeout_s)
        return 200, {}

    def _session_id(self) -> str:
        folder, _, session_id = urlsplit(self.path).path.rpartition("/")
        if folder != "/sessions" or not SESSION_ID.fullmatch(session_id):
            raise KeeperError(404, "not_found", "There is no such address.")
        return session_id

    def _body(self) -> dict[str, Any]:
        try:
            length = int(self.headers.get("Content-Length", ""))
            if not 0 < length <= MAX_BODY_BYTES:
                raise ValueError("too long")
            body = json.loads(self.rfile.read(length))
        except (ValueError, RecursionError):
            raise KeeperError(400, "bad_request", "The body is no JSON object.") from None
        if not isinstance(body, dict):
            raise KeeperError(400, "bad_request", "The body is no JSON object.")
        return body

    def _run(self, request: Any) -> None:
        try:
            status, answer = request()
        except KeeperError as error:
            log.info("%s %s: %s", self.command, self.path, error.detail)
            status, answer = error.status, {"code": error.code, "detail": error.detail, "log": error.log}
        except Exception as error:
            log.exception("%s %s", self.command, self.path)
            status, answer = 500, {"code": "keeper_failed", "detail": f"The keeper failed: {error}."}
        data = json.dumps(answer).encode()
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(data)))
        self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(data)

    def address_string(self) -> str:
        """Returns an empty name, since clients of a unix socket have no address."""
        return "web"

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 - the base class's name
        """Does nothing: requests are not logged."""


def _names(body: dict[str, Any], what: str) -> bool:
    """Returns whether a body has a valid id (in the field `what`), a valid token and a valid timeout."""
    made_id, token, timeout_s = body.get(what), body.get("token"), body.get("timeout_s", 30)
    return (
        isinstance(made_id, str)
        and SESSION_ID.fullmatch(made_id) is not None
        and isinstance(token, str)
        and TOKEN.fullmatch(token) is not None
        and isinstance(timeout_s, int | float)
        and 0 < timeout_s <= MAX_TIMEOUT_S
    )
