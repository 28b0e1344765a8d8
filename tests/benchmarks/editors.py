"""Simulated editors for `load`: users of the API with a permanent connection, and their measurements."""

from __future__ import annotations

import asyncio
import json
import random
import time
from dataclasses import dataclass, field

from websockets.asyncio.client import connect
from websockets.typing import Origin

CHANCE = random.Random(1)  # noqa: S311 - it spreads requests
EXTRA = {"list": 0.1, "open": 0.1}
"""How often a save is followed by something else."""


@dataclass
class Measured:
    """Times by kind of request, and the errors."""

    times_ms: dict[str, list[float]] = field(default_factory=dict)
    errors: dict[str, int] = field(default_factory=dict)

    def add(self, kind: str, seconds: float, status: int) -> None:
        """Adds one answer."""
        if status >= 400:
            self.errors[f"{kind} {status}"] = self.errors.get(f"{kind} {status}", 0) + 1
        self.times_ms.setdefault(kind, []).append(1000 * seconds)


class Editor:
    """One user of the API; `credentials` is the header that identifies the user."""

    def __init__(self, number: int, port: int, credentials: tuple[str, str], measured: Measured) -> None:
        self._number, self._port, self._measured = number, port, measured
        self._credentials = credentials
        self._head = f"Host: 127.0.0.1:{port}\r\n{credentials[0]}: {credentials[1]}\r\n"

    async def open(self) -> None:
        """Connects, and creates a project."""
        await self._connect()
        body = {"name": f"Load {self._number}", "template": "laser_bump_and_go"}
        self._project = await self._ask("create", "POST", "projects", body)
        path = "trees/MainTree.json"
        files = {file["path"]: file for file in self._project["files"]}
        self._revision, self._diagram = files[path]["revision"], json.loads(files[path]["content"])

    async def leave(self) -> None:
        """Disconnects."""
        self._writer.close()
        await self._writer.wait_closed()

    def look(self) -> connect:
        """Opens a socket that waits for notices of the project."""
        uri = f"ws://127.0.0.1:{self._port}/ws/projects/{self._project['id']}/notices"
        headers = dict([self._credentials])
        return connect(
            uri, additional_headers=headers, origin=Origin(f"http://127.0.0.1:{self._port}"), proxy=None
        )

    async def save(self) -> None:
        """Moves a block, and saves the tree."""
        self._diagram["nodes"]["n1"]["position"] = [CHANCE.randrange(2000), CHANCE.randrange(2000)]
        content = json.dumps(self._diagram)
        change = {"path": "trees/MainTree.json", "content": content, "base_revision": self._revision}
        answer = await self._ask(
            "save", "POST", f"projects/{self._project['id']}/changes", {"files": [change]}
        )
        self._revision = answer.get("revision", self._revision)

    async def work(self, until: float, pace_s: float) -> None:
        """Saves every `pace_s`, each editor at a different moment; without pauses if that is 0."""
        await asyncio.sleep(CHANCE.random() * pace_s)
        while time.monotonic() < until:
            started = time.monotonic()
            await self.save()
            if pace_s:
                if CHANCE.random() < EXTRA["list"]:
                    await self._ask("list", "GET", "projects?limit=20")
                if CHANCE.random() < EXTRA["open"]:
                    await self._ask("open", "GET", f"projects/{self._project['id']}")
                if started + pace_s >= until:
                    return
                await asyncio.sleep(max(0.0, started + pace_s - time.monotonic()))

    async def _ask(self, kind: str, method: str, path: str, body: object = None) -> dict:
        return (await self.asked(kind, method, path, body))[1]

    async def asked(self, kind: str, method: str, path: str, body: object = None) -> tuple[int, dict]:
        """Makes one request; returns its status, and the answer as JSON."""
        data = b"" if body is None else json.dumps(body).encode()
        head = f"{method} /api/v1/{path} HTTP/1.1\r\n{self._head}Content-Length: {len(data)}\r\n"
        head += "Content-Type: application/json\r\n\r\n"
        started = time.perf_counter()
        lines = (await self._sent(head.encode() + data)).decode("latin-1").split("\r\n")
        fields = dict(line.lower().split(": ", 1) for line in lines[1:] if ": " in line)
        if "content-length" in fields:
            answer = await self._reader.readexactly(int(fields["content-length"]))
        else:
            answer = await self._chunks()
        status = int(lines[0].split()[1])
        self._measured.add(kind, time.perf_counter() - started, status)
        return status, json.loads(answer) if answer else {}

    async def _sent(self, request: bytes) -> bytes:
        """Returns the head of the answer; reopens a connection that was closed while idle."""
        try:
            self._writer.write(request)
            return await self._reader.readuntil(b"\r\n\r\n")
        except (asyncio.IncompleteReadError, ConnectionError):
            self._writer.close()
            await self._connect()
            self._writer.write(request)
            return await self._reader.readuntil(b"\r\n\r\n")

    async def _connect(self) -> None:
        self._reader, self._writer = await asyncio.open_connection("127.0.0.1", self._port)

    async def _chunks(self) -> bytes:
        data = b""
        while size := int(await self._reader.readline(), 16):
            data += await self._reader.readexactly(size)
            await self._reader.readline()
        await self._reader.readline()
        return data
