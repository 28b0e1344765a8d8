"""Access to a manager by token, host and origin: the rules alone, and over real sockets."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import sys

import pytest
from websockets.asyncio.client import connect
from websockets.datastructures import Headers
from websockets.exceptions import InvalidStatus
from websockets.http11 import Request
from websockets.typing import Origin

from executor.manager.admission import Admission
from executor.manager.manager import Manager, ManagerSettings
from tests.executor.manager.test_server import manager
from tests.executor.session_client import ROOT

RIGHT = {"Authorization": "Bearer secret"}
LISTED = frozenset({"https://studio.example"})
WITH, WITHOUT = Admission("secret", LISTED), Admission("", LISTED)


def judged(admission, path="/control", **headers):
    headers = {name.replace("_", "-"): value for name, value in headers.items()}
    given = {"Host": "127.0.0.1:7163"} | headers
    refusal = admission.judge(Request(path, Headers(given)), reads_health=path == "/health")
    return None if refusal is None else refusal.status.value


@pytest.mark.parametrize("host", ["127.0.0.1:7163", "evil.example:7163", "robot.lan", "10.0.0.5:1", ""])
def test_with_the_right_token_every_host_is_answered(host):
    assert judged(WITH, Host=host, **RIGHT) is None
    assert judged(WITH, "/control?client=x&token=secret", Host=host) is None


@pytest.mark.parametrize("given", ["", "secret", "Bearer", "Bearer Secret", "Bearer sécret", "Basic secret"])
def test_without_the_token_only_health_is_answered(given):
    for path in ("/control", "/stream", "/metrics", "/x", "/control?token=wrong", "/control?token="):
        assert judged(WITH, path, Authorization=given) == 401
    assert judged(WITH, "/health", Authorization=given) is None


def test_health_is_answered_to_probes_by_address_and_to_no_rebound_name():
    for host in ("localhost:7163", "[::1]:7163", "10.0.0.5:7163"):
        assert judged(WITH, "/health", Host=host) is None
    for host in ("evil.example:7163", "localhost.evil.example", "127.0.0.1.evil.example", "", "[::1"):
        assert judged(WITH, "/health", Host=host) == 401
    assert judged(WITHOUT, "/health", Host="10.0.0.5:7163") == 421


@pytest.mark.parametrize("origin", ["http://localhost:7163", "https://evil.example", "null", "http://["])
def test_with_a_token_a_page_must_be_listed(origin):
    assert judged(WITH, Origin=origin, **RIGHT) == 403
    assert judged(WITH, "/health", Origin=origin) == 403
    assert judged(WITH, Origin="https://studio.example", **RIGHT) is None


@pytest.mark.parametrize("path", ["/control", "/stream", "/health", "/metrics"])
def test_without_a_token_host_and_origin_must_be_of_this_machine(path):
    assert judged(WITHOUT, path) is None
    assert judged(WITHOUT, path, Origin="http://localhost:3000") is None
    assert judged(WITHOUT, path, Origin="https://studio.example") is None
    assert judged(WITHOUT, path, Host="evil.example:7163") == 421
    assert judged(WITHOUT, path, Origin="https://evil.example") == 403
    assert judged(WITHOUT, path, Origin="http://localhost.evil.example") == 403


def test_a_header_that_came_twice_is_refused():
    twice = Headers([("Host", "localhost"), ("Host", "evil.example")])
    assert WITHOUT.judge(Request("/control", twice)).status == 421


async def test_a_page_of_another_site_cannot_take_a_manager_over():
    async with manager() as it:
        url = f"ws://127.0.0.1:{it.port}/control"
        for headers in ({}, RIGHT):
            with pytest.raises(InvalidStatus) as caught:
                await connect(
                    url, proxy=None, origin=Origin("https://evil.example"), additional_headers=headers
                )
            assert caught.value.response.status_code == (403 if headers else 401)


async def test_without_a_token_it_listens_on_loopback_alone():
    it = Manager(ManagerSettings(host="0.0.0.0", port=0, programs={}))  # noqa: S104
    with pytest.raises(OSError, match="loopback"):
        await it.start()
    await it.close()


@contextlib.asynccontextmanager
async def typed(*arguments, **variables):
    """Runs `python -m executor.manager` as a user types it."""
    process = await asyncio.create_subprocess_exec(
        *(sys.executable, "-m", "executor.manager", "--port", "0", *arguments),
        stderr=asyncio.subprocess.PIPE,
        cwd=ROOT,
        env=os.environ | variables,
    )
    try:
        yield process
    finally:
        with contextlib.suppress(ProcessLookupError):
            process.terminate()
        await process.communicate()


async def line_with(process, word):
    async with asyncio.timeout(120):
        while word not in (line := (await process.stderr.readline()).decode()):
            assert line, "the manager ended"
    return line.strip()


async def test_a_manager_prints_the_token_that_it_requires():
    async with typed("--allow-origin", "https://studio.example") as process:
        bearer = (await line_with(process, "Bearer")).rpartition(" ")[2]
        url = (await line_with(process, "ws://")).rpartition(" ")[2]
        bare, _, token = url.partition("?token=")
        assert bearer == token
        with pytest.raises(InvalidStatus):
            await connect(bare, proxy=None)
        async with connect(url, proxy=None, origin=Origin("https://studio.example")) as socket:
            assert json.loads(await socket.recv())["command"] == "introspection"
        async with connect(bare, proxy=None, additional_headers={"Authorization": f"Bearer {token}"}):
            pass


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("--no-token", "--host", "192.0.2.1"), "loopback"),
        (("--ram", "--host", "192.0.2.1"), "loopback"),
        (("--token-env", "NOBODY_SET_THIS"), "NOBODY_SET_THIS"),
        (("--no-token", "--token-env", "HOME"), "exclude"),
    ],
)
async def test_insecure_options_are_refused_in_one_line(arguments, reason):
    async with typed(*arguments) as process:
        _, said = await process.communicate()
        assert (process.returncode, said.decode().count("\n")) == (2, 1)
        assert reason in said.decode()
