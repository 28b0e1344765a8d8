"""200 editors who save every 3 s: how long they wait, how many saves there can be, and what one costs.

`python -m tests.benchmarks.load [--editors 200] [--seconds 30] [--sqlite]`. The editors have a core of their
own; web server and PostgreSQL share the rest, so that figures are those of one core on a machine with two.
Each editor saves a diagram, and lists and opens projects now and then; 50 more look at nothing that happens.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import random
import statistics
import tempfile
import time
from contextlib import AsyncExitStack, ExitStack
from dataclasses import dataclass, field
from pathlib import Path

import psutil
from websockets.asyncio.client import connect

from tests.backend.services import postgresql
from tests.backend.serving import serving

PERIOD_S = 3.0
IDLE_SOCKETS = 50
CHANCE = random.Random(1)  # noqa: S311 - it spreads requests
EXTRA = {"list": 0.1, "open": 0.1}


@dataclass
class Measured:
    """Times by kind of request, and what went wrong."""

    times_ms: dict[str, list[float]] = field(default_factory=dict)
    errors: dict[str, int] = field(default_factory=dict)

    def add(self, kind: str, seconds: float, status: int) -> None:
        if status >= 400:
            self.errors[f"{kind} {status}"] = self.errors.get(f"{kind} {status}", 0) + 1
        self.times_ms.setdefault(kind, []).append(1000 * seconds)


class Editor:
    """One user of the API with a connection that stays."""

    def __init__(self, number: int, port: int, token: str, measured: Measured) -> None:
        self._number, self._port, self._measured = number, port, measured
        self._head = f"Host: 127.0.0.1:{port}\r\nAuthorization: Bearer {token}\r\n"
        self._saves = 0
        self._token = token

    async def open(self) -> None:
        await self._connect()
        body = {"name": f"Load {self._number}", "template": "laser_bump_and_go"}
        self._project = await self._ask("create", "POST", "projects", body)
        path = "trees/MainTree.json"
        files = {file["path"]: file for file in self._project["files"]}
        self._revision, self._diagram = files[path]["revision"], json.loads(files[path]["content"])

    def look(self) -> connect:
        """A socket that waits for news of the project."""
        uri = f"ws://127.0.0.1:{self._port}/ws/projects/{self._project['id']}/notices"
        return connect(uri, additional_headers={"Authorization": f"Bearer {self._token}"}, proxy=None)

    async def save(self) -> None:
        self._saves += 1
        self._diagram["nodes"]["n1"]["position"] = [self._saves, self._number]
        content = json.dumps(self._diagram)
        change = {"path": "trees/MainTree.json", "content": content, "base_revision": self._revision}
        answer = await self._ask(
            "save", "POST", f"projects/{self._project['id']}/changes", {"files": [change]}
        )
        self._revision = answer.get("revision", self._revision)

    async def work(self, until: float, pace_s: float) -> None:
        await asyncio.sleep(CHANCE.random() * pace_s)
        while time.monotonic() < until:
            started = time.monotonic()
            await self.save()
            if pace_s:
                if CHANCE.random() < EXTRA["list"]:
                    await self._ask("list", "GET", "projects?limit=20")
                if CHANCE.random() < EXTRA["open"]:
                    await self._ask("open", "GET", f"projects/{self._project['id']}")
                await asyncio.sleep(max(0.0, pace_s - (time.monotonic() - started)))

    async def _ask(self, kind: str, method: str, path: str, body: object = None) -> dict:
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
        return json.loads(answer) if answer else {}

    async def _sent(self, request: bytes) -> bytes:
        """The head of the answer; a connection that was closed while idle is opened again."""
        try:
            self._writer.write(request)
            return await self._reader.readuntil(b"\r\n\r\n")
        except (asyncio.IncompleteReadError, ConnectionError):
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


def cpu_s() -> float:
    """The processor time of web server and database, which are all children of this process."""
    total = 0.0
    for member in psutil.Process().children(recursive=True):
        try:
            times = member.cpu_times()
        except psutil.Error:
            continue
        total += times.user + times.system
    return total


async def measure(port: int, token: str, editors: int, seconds: float) -> None:
    """The editors at their pace, then a fifth of them as fast as they can."""
    measured = Measured()
    everyone = [Editor(number, port, token, measured) for number in range(editors)]
    for some in range(0, editors, 10):
        await asyncio.gather(*(editor.open() for editor in everyone[some : some + 10]))
    async with AsyncExitStack() as viewers:
        for editor in everyone[:IDLE_SOCKETS]:
            await viewers.enter_async_context(editor.look())
        await storm(everyone, measured, seconds)


async def storm(everyone: list[Editor], measured: Measured, seconds: float) -> None:
    """The two loads, one after the other."""
    editors = len(everyone)
    measured.times_ms.clear()
    before, started = cpu_s(), time.monotonic()
    await asyncio.gather(*(editor.work(started + seconds, PERIOD_S) for editor in everyone))
    report(f"{editors} editors, a save every {PERIOD_S:g} s", measured, started, cpu_s() - before)
    measured.times_ms.clear()
    before, started = cpu_s(), time.monotonic()
    await asyncio.gather(*(editor.work(started + seconds / 2, 0) for editor in everyone[: editors // 5]))
    report(f"{editors // 5} editors without a pause", measured, started, cpu_s() - before)


def report(title: str, measured: Measured, started: float, used_s: float) -> None:
    """Prints quantiles, the rate and the cost."""
    took = time.monotonic() - started
    print(f"{title}: {took:.0f} s, load average {os.getloadavg()[0]:.1f}")
    for kind, times in sorted(measured.times_ms.items()):
        cuts = statistics.quantiles(times, n=20) if len(times) > 1 else times * 19
        quantiles = f"p50 {cuts[9]:7.1f} ms  p95 {cuts[18]:7.1f} ms  max {max(times):7.1f} ms"
        print(f"  {kind:6} {len(times):6}  {quantiles}")
    saves = len(measured.times_ms.get("save", [])) or 1
    cost_ms = 1000 * used_s / saves
    print(f"  {saves / took:.0f} saves a second, {cost_ms:.1f} ms of server and database CPU a save")
    print(f"  errors: {measured.errors or 'none'}")


def main() -> None:
    """Starts database and server, keeps them off the editors' core, and measures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--editors", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("--sqlite", action="store_true")
    options, _ = parser.parse_known_args()
    cores = sorted(os.sched_getaffinity(0))
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        os.sched_setaffinity(0, set(cores[:-1]) or set(cores))
        settings = {} if options.sqlite else {"BT_STUDIO_DATABASE_URL": stack.enter_context(postgresql())}
        print("SQLite" if options.sqlite else "PostgreSQL")
        served = stack.enter_context(serving(folder, **settings))
        os.sched_setaffinity(0, {cores[-1]})
        asyncio.run(measure(served.port, served.token, options.editors, options.seconds))


if __name__ == "__main__":
    main()
