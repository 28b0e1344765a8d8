"""Uploads that are read in a user's tools."""

from __future__ import annotations

import asyncio
import json

import psutil
import pytest

from executor.tools.uploads import import_upload
from tests.executor.expansion.probes import probes, was_refused
from tests.executor.tools.test_server import client, tools
from tests.executor.uploads.zips import PACKAGE, zipped

SLOW = b'<robot name="r" xmlns:xacro="http://x"><link name="${sum(1 for i in range(10**9))}"/></robot>'


def message(data, **wish):
    header = {"filename": "r.xacro", "kind": "", "main": "", "name": "", "arguments": {}, "simplify": False}
    return json.dumps(header | wish).encode() + b"\n" + data


async def in_parts(data):
    for begin in range(0, len(data), 1 << 20):
        yield data[begin : begin + (1 << 20)]


def children():
    return [child.pid for child in psutil.Process().children(recursive=True)]


async def test_an_upload_is_read_in_a_child_that_ends_with_the_connection(tmp_path):
    async with tools(tmp_path) as (path, _):
        answer = json.loads(
            await import_upload(in_parts(message(zipped(PACKAGE), filename="a.zip")), tmp_path)
        )
        assert [item["name"] for item in answer["items"]] == ["cart"]
        (tmp_path / "secret.yaml").write_text("word: hidden")
        *_, last = probes(tmp_path / "secret.yaml")
        async with client(path, "uploads") as socket:
            await socket.send(message(last.encode(), kind="robot"))
            [found] = json.loads(await socket.recv())["error"]["diagnostics"]
            assert was_refused(found["message"])
        before = children()
        async with client(path, "uploads") as socket:
            await socket.send(message(SLOW, kind="robot"))
            while len(children()) < len(before) + 2:  # noqa: ASYNC110 - the child, and that of the macros
                await asyncio.sleep(0.02)
        while children() != before:  # noqa: ASYNC110 - a process gives no event
            await asyncio.sleep(0.02)


async def test_a_child_that_ends_before_its_upload_is_logged_and_the_upload_read(tmp_path, caplog):
    parts = in_parts(b"[" * (12 << 20))
    monkey = "executor.uploads.none"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("executor.tools.uploads.CHILD", monkey)
        assert await import_upload(parts, tmp_path) == ""
    assert [part async for part in parts] == []
    assert f"No module named {monkey}" in caplog.text
