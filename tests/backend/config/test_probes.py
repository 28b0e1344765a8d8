"""Liveness, readiness and metrics, before any guard; and log lines that programs can read."""

from __future__ import annotations

import json
import logging
import sys
from typing import Any

import pytest

from backend.config import probes
from backend.config.environment import environment
from backend.config.healthcheck import READY
from backend.core.logs import JsonFormatter, TextFormatter
from backend.core.processes import metrics
from backend.core.processes.threads import Threads

pytestmark = pytest.mark.django_db(transaction=True)


class Busy(Threads):
    """A pool of threads of which none has been free for a while."""

    def __init__(self, *, full_s=0.0, stuck_s=0.0):
        super().__init__(1, "busy")
        self.full_for_s = lambda: full_s  # type: ignore[method-assign]
        self.stuck_for_s = lambda: stuck_s  # type: ignore[method-assign]


async def ask(path, *, client=("127.0.0.1", 5), headers=(), inner=None, threads=None):
    """Returns status and body of an answer."""
    sent = []

    async def send(message):
        sent.append(message)

    async def application(scope, receive, send):
        await send({"type": "http.response.start", "status": 404, "headers": []})
        await send({"type": "http.response.body", "body": b""})

    scope: Any = {"type": "http", "path": path, "method": "GET", "client": client, "headers": list(headers)}
    await probes.probed(inner or application, threads or Busy())(scope, None, send)
    return sent[0]["status"], b"".join(message.get("body", b"") for message in sent[1:]).decode()


async def test_a_process_that_answers_is_alive_and_ready():
    assert await ask(probes.LIVE, client=("10.0.0.9", 5)) == (200, '{"status": "ok"}\n')
    assert (await ask(READY, client=("10.0.0.9", 5)))[0] == 200


def host(name):
    return [(b"host", name.encode())]


@pytest.mark.parametrize("path", [probes.LIVE, READY, probes.METRICS])
async def test_a_page_whose_name_was_made_to_point_here_learns_nothing(path, settings_of):
    for name in ("evil.example", "evil.example:8000", "127.0.0.1.evil.example"):
        status, body = await ask(path, headers=host(name))
        assert (status, json.loads(body)["code"]) == (421, "host_refused")
    settings_of(allowed_hosts='["web"]')
    for name in ("127.0.0.1:8000", "localhost:8000", "[::1]:8000", "10.0.0.5:8000", "web:8000"):
        assert (await ask(path, headers=host(name)))[0] == 200


async def test_the_metrics_of_a_server_behind_a_proxy_on_its_machine_are_not_for_all(settings_of):
    forwarded = [(b"x-forwarded-for", b"203.0.113.7")]
    assert (await ask(probes.METRICS, headers=forwarded))[0] == 403
    settings_of(metrics_token="t0ken")
    shown = [(b"authorization", b"Bearer t0ken"), *host("prometheus.internal"), *forwarded]
    assert (await ask(probes.METRICS, headers=shown))[0] == 200
    assert (await ask(probes.METRICS))[0] == 403


async def test_probes_have_the_headers_of_every_answer():
    sent = []

    async def send(message):
        sent.append(message)

    scope: Any = {
        "type": "http",
        "path": probes.LIVE,
        "method": "GET",
        "client": ("127.0.0.1", 5),
        "headers": [],
    }
    await probes.probed(None, Busy())(scope, None, send)
    names = {name.lower() for name, _ in sent[0]["headers"]}
    assert {
        b"x-content-type-options",
        b"content-security-policy",
        b"x-frame-options",
        b"cache-control",
    } <= names


async def test_a_server_without_its_database_is_alive_and_not_ready(monkeypatch):
    monkeypatch.setattr(probes, "trouble", lambda: "The database does not answer: OperationalError.")
    status, body = await ask(READY)
    assert status == 503
    assert "database" in json.loads(body)["detail"]
    assert (await ask(probes.LIVE))[0] == 200


@pytest.mark.parametrize(
    ("path", "busy", "status"),
    [
        (READY, {"full_s": 9.0}, 200),
        (READY, {"full_s": 11.0}, 503),
        (probes.LIVE, {"full_s": 300.0, "stuck_s": 59.0}, 200),
        (probes.LIVE, {"full_s": 61.0, "stuck_s": 61.0}, 503),
    ],
)
async def test_threads_that_are_never_free_cost_readiness_first_and_life_much_later(path, busy, status):
    found, body = await ask(path, threads=Busy(**busy))
    assert found == status
    assert ("No request thread" in body) == (status == 503)


async def test_metrics_count_requests_and_sessions():
    def count(text):
        return next(
            float(row.split()[1]) for row in text.splitlines() if 'requests_total{status="4xx"}' in row
        )

    before = count((await ask(probes.METRICS))[1])
    await ask("/nowhere")
    status, text = await ask(probes.METRICS)
    assert (status, count(text)) == (200, before + 1)
    assert 'bt_studio_sessions{state="queued"} 0.0' in text
    assert 'bt_studio_work_jobs{state="waiting"} 0.0' in text


async def test_metrics_are_not_for_everybody(monkeypatch):
    assert (await ask(probes.METRICS, client=("172.18.0.1", 5)))[0] == 403
    from pydantic import SecretStr

    changed = environment().model_copy(update={"metrics_token": SecretStr("m3trics")})
    monkeypatch.setattr(probes, "environment", lambda: changed)
    assert (await ask(probes.METRICS))[0] == 403
    assert (await ask(probes.METRICS, headers=[(b"authorization", b"Bearer m3trics")]))[0] == 200


async def test_a_request_that_fails_is_counted_as_such():
    async def broken(scope, receive, send):
        raise RuntimeError("defect")

    before = metrics.requests.totals()
    with pytest.raises(RuntimeError):
        await ask("/api", inner=broken)
    assert metrics.requests.totals() == before | {"5xx": before["5xx"] + 1}


async def test_a_request_is_counted_once_before_its_client_has_all_of_the_answer():
    before, counts = metrics.requests.totals(), []

    async def send(message):
        if message["type"] == "http.response.body":
            counts.append(metrics.requests.totals()["2xx"] - before["2xx"])

    async def in_pieces(scope, receive, send):
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": b"a", "more_body": True})
        await send({"type": "http.response.body", "body": b"b"})

    scope: Any = {"type": "http", "path": "/api", "method": "GET", "client": ("127.0.0.1", 5), "headers": []}
    await probes.probed(in_pieces, Busy())(scope, None, send)
    assert counts == [0, 1]
    assert metrics.requests.totals() == before | {"2xx": before["2xx"] + 1}


def test_a_log_line_is_one_json_object_with_its_facts():
    try:
        raise ValueError("two\nlines")
    except ValueError:
        record = logging.LogRecord("bt", logging.ERROR, "", 1, "save %s", ("§",), sys.exc_info())
    record.facts = {"status": 500}
    line = JsonFormatter().format(record)
    found = json.loads(line)
    assert "\n" not in line
    assert (found["message"], found["status"], found["level"]) == ("save §", 500, "error")
    assert "ValueError" in found["exception"]
    assert "status=500" in TextFormatter().format(record)
