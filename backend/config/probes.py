"""Answers probes of orchestrators and monitors (alive, ready, metrics) before the guard; logs all requests.

* `/health/live`: this process answers, and its request threads made progress within a minute. The time is
long, since a restart during an attack would help the attacker.
* `/health/ready`: the process and its database answer, and a request thread was free within ten seconds.
* `/metrics`: Prometheus' text, for programs on this machine, or those that send `BT_STUDIO_METRICS_TOKEN`.

If a server has several workers (`parent.py`), each worker answers for all: the server is alive and ready
while one worker is, and its counters are the sums over all workers.

The `Host` of a probe must be an IP address, a known name of the server, or missing. So a page of another site
learns nothing, even if its name was rebound to this server.
"""

from __future__ import annotations

import contextlib
import hmac
import json
import logging
import time
from ipaddress import ip_address
from typing import TYPE_CHECKING, Any, Final

from channels.db import database_sync_to_async

from backend.config.environment import environment
from backend.config.healthcheck import READY
from backend.core import guard
from backend.core.clients import is_on_this_machine
from backend.core.problems import MEDIA_TYPE, problem
from backend.core.processes import metrics
from backend.core.processes.numbers import FULL, STUCK
from backend.core.processes.siblings import least_s
from backend.core.scopes import headers_of
from backend.ingress.middleware import headers_of_all

if TYPE_CHECKING:
    from collections.abc import Mapping

    from asgiref.typing import ASGI3Application, ASGIReceiveCallable, ASGISendCallable, HTTPScope, Scope

    from backend.core.processes.threads import Threads

log = logging.getLogger("bt_studio.access")

LIVE: Final = "/health/live"
METRICS: Final = "/metrics"


NOT_READY_S: Final = 10.0
"""Seconds for which no request thread is free, after which the server counts as not ready."""
NOT_LIVE_S: Final = 60.0
"""Seconds in which no request ends, after which the server counts as not alive."""


def probed(application: ASGI3Application, threads: Threads) -> ASGI3Application:
    """Returns the application with the probes before it, measured and logged.

    Args:
        application: the application behind the probes.
        threads: the threads that answer its requests.
    """

    async def entry(scope: Scope, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:
        if scope["type"] == "http":
            await _http(application, threads, scope, receive, send)
        elif scope["type"] == "websocket":
            metrics.sockets.add("opened")
            try:
                await application(scope, receive, send)
            finally:
                metrics.sockets.add("ended")
        else:
            await application(scope, receive, send)

    return entry


async def _http(
    application: ASGI3Application,
    threads: Threads,
    scope: HTTPScope,
    receive: ASGIReceiveCallable,
    send: ASGISendCallable,
) -> None:
    path = scope["path"]
    if path in {LIVE, READY, METRICS}:
        status, kind, body = await _answer(scope, threads)
        own = {"Content-Type": kind, "Cache-Control": "no-store"}
        headers = [(name.encode(), value.encode()) for name, value in (headers_of_all() | own).items()]
        await send({"type": "http.response.start", "status": status, "headers": headers, "trailers": False})
        await send({"type": "http.response.body", "body": body.encode(), "more_body": False})
        return
    started = time.perf_counter()
    status = 500
    is_counted = False

    def count() -> None:
        nonlocal is_counted
        if not is_counted:
            is_counted = True
            metrics.requests.add(f"{status // 100}xx")
            metrics.request_seconds.observe(time.perf_counter() - started)

    async def noting_send(message: Any) -> None:
        nonlocal status
        if message["type"] == "http.response.start":
            status = message["status"]
        elif message["type"] == "http.response.body" and not message.get("more_body", False):
            # Before the client has all of it: what it asks for next shows its own count, by any worker.
            count()
        await send(message)

    try:
        await application(scope, receive, noting_send)
    finally:
        count()
        seconds = time.perf_counter() - started
        # The query is left out: it may contain a token.
        facts = {"method": scope["method"], "path": path, "status": status, "ms": round(1000 * seconds, 1)}
        log.debug("request", extra={"facts": facts})


async def _answer(scope: HTTPScope, threads: Threads) -> tuple[int, str, str]:
    headers = headers_of(scope)
    shows_token = _shows_token(headers)
    refusal = None if shows_token else _judge_host(headers.get("host", ""))
    if refusal is not None:
        document = problem(refusal.status, refusal.code, detail=refusal.detail, hint=refusal.hint)
        return refusal.status, MEDIA_TYPE, json.dumps(document) + "\n"
    if scope["path"] == LIVE:
        return _health(_late("has answered", least_s(STUCK, threads.stuck_for_s()), NOT_LIVE_S))
    if scope["path"] == READY:
        late = _late("has been free", least_s(FULL, threads.full_for_s()), NOT_READY_S)
        return _health(late or await database_sync_to_async(trouble)())
    if not shows_token and not _may_measure(scope, headers):
        return 403, "text/plain", "Show BT_STUDIO_METRICS_TOKEN as a bearer token.\n"
    return 200, *await database_sync_to_async(_metrics)()


def _late(what: str, seconds: float, limit_s: float) -> str:
    return f"No request thread {what} for {seconds:.0f} s." if seconds > limit_s else ""


def _health(trouble: str) -> tuple[int, str, str]:
    answer = {"status": "failed", "detail": trouble} if trouble else {"status": "ok"}
    return 503 if trouble else 200, "application/json", json.dumps(answer) + "\n"


def _judge_host(host: str) -> guard.Refusal | None:
    if not host:  # every browser sends it
        return None
    with contextlib.suppress(ValueError):
        ip_address(guard.host_name(host).strip("[]"))
        return None
    return guard.judge_host(host, guard.known_hosts())


def _shows_token(headers: Mapping[str, str]) -> bool:
    token = environment().metrics_token.get_secret_value()
    given = headers.get("authorization", "")
    return bool(token) and hmac.compare_digest(given.encode(), f"Bearer {token}".encode())


def _may_measure(scope: HTTPScope, headers: Mapping[str, str]) -> bool:
    if environment().metrics_token.get_secret_value():
        return False
    client = scope["client"]
    return client is not None and is_on_this_machine(client[0], headers)


def trouble() -> str:
    """Returns the reason why the database cannot be used; "" if it can."""
    from django.db import Error, connection  # noqa: PLC0415 - Django must be set up first

    try:
        with connection.cursor() as cursor:
            cursor.execute("SELECT 1")
    except Error as error:
        return f"The database does not answer: {type(error).__name__}."
    return ""


def _metrics() -> tuple[str, str]:
    # Django must be set up first, and the server starts sooner without Prometheus' client.
    from backend.config.metrics_page import CONTENT_TYPE, page  # noqa: PLC0415

    return CONTENT_TYPE, page()
