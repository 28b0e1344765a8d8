"""The page that shows a run: access, pictures, and the viewer's camera."""

from __future__ import annotations

import asyncio
import json
from typing import Any

import pytest
import requests
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

from executor.headless.viewer import RunViewer

LOOK = {"eye": [1.0, 2.0, 3.0], "target": [0.0, 0.0, 0.0]}


async def served(use):
    looks: asyncio.Queue[Any] = asyncio.Queue()
    viewer = RunViewer(TOKEN, looks.put_nowait)
    url = await viewer.start()
    try:
        return await use(viewer, url.split("/?")[0], looks)
    finally:
        await viewer.close()


def socket_of(origin, token):
    return origin.replace("http", "ws") + f"/socket?token={token}"


TOKEN = "a-token"


async def get(url, **more):
    return await asyncio.to_thread(requests.get, url, timeout=60, **more)


def test_the_page_needs_nothing_from_elsewhere_and_runs_no_inline_script():
    async def use(_viewer, origin, _looks):
        page = await get(origin + "/")
        assert page.headers["Content-Type"].startswith("text/html")
        policy = page.headers["Content-Security-Policy"]
        assert policy.startswith("default-src 'self'")
        assert "unsafe" not in policy
        for name in ("viewer.js", "viewer.css"):
            assert name in page.text
            file = await get(f"{origin}/{name}")
            assert (file.status_code, "://" in file.text.replace("}://", "")) == (200, False)
        assert (await get(f"{origin}/%2e%2e/live.py")).status_code == 404

    asyncio.run(served(use))


def test_a_late_viewer_gets_the_last_picture_and_figures_and_may_look_elsewhere():
    async def use(viewer, origin, looks):
        viewer.tell({"status": "RUNNING"})
        viewer.show(b"first")
        async with connect(socket_of(origin, TOKEN), origin=origin) as socket:
            assert json.loads(await socket.recv()) == {"status": "RUNNING"}
            assert await socket.recv() == b"first"
            for rubbish in ("{", '{"eye": "up"}', b"\x00"):
                await socket.send(rubbish)
            await socket.send(json.dumps(LOOK))
            there = await looks.get()
            viewer.show(b"second")
            assert await socket.recv() == b"second"
        assert list(there.eye) == LOOK["eye"]
        assert await looks.get() is None

    asyncio.run(asyncio.wait_for(served(use), 60))


@pytest.mark.parametrize(
    ("token", "origin"), [("wrong", None), ("", None), ("a-token", "http://evil.example"), ("a-token", "")]
)
def test_strangers_and_other_pages_see_nothing(token, origin):
    async def use(_viewer, own, _looks):
        with pytest.raises(InvalidStatus) as refused:
            async with connect(socket_of(own, token), origin=own if origin is None else origin):
                pass
        return refused.value.response.status_code

    assert asyncio.run(served(use)) == 403


def test_a_rebound_host_name_is_refused():
    async def use(_viewer, origin, _looks):
        return (await get(origin, headers={"Host": "evil.example"})).status_code

    assert asyncio.run(served(use)) == 403
