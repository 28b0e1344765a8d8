"""A client of a real manager process: sends commands, waits for events, decodes every frame."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import json
import os
import sys
import time
from pathlib import Path

import msgspec
import psutil
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from executor.messages import Camera, Poses, RecordingPart, Scan, Scene, View
from executor.stream.pose_codec import POSE_BYTES, unpack
from tests.deadline import DEADLINE_S
from translator import load, to_app_zip

ROOT = Path(__file__).parents[2]
TOKEN = "secret"
LAST_EVENTS = 6  # of an error of a client that waited in vain
decode_frame = msgspec.msgpack.Decoder(Scene | Poses | Scan | Camera | View | RecordingPart).decode


def app_zip(example="laser_bump_and_go", **overlay):
    """Returns the app of an example as base64; `overlay` replaces actions by name."""
    folder = ROOT / "examples" / example
    files = {
        str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*.*") if "__pycache__" not in str(p)
    }
    files |= {f"actions/{name}.py": source.encode() for name, source in overlay.items()}
    return base64.b64encode(to_app_zip(load(files))).decode()


def run_data(app=None, universe="walled_room", **more):
    application = {"app_zip_base64": app or app_zip(), "tick_hz": 20.0, "on_finish": "repeat", **more}
    return {"universe": {"universe": universe, "seed": 1}, "application": application}


class SessionClient:
    """One client's two sockets."""

    def __init__(self, port):
        self.port = port
        self.events = []
        self.frames = []
        self._changed = asyncio.Condition()
        self._requests = 0
        self.headers = {"Authorization": f"Bearer {TOKEN}"}
        self._tasks = []

    async def open(self, *, client=None, stream=True):
        query = f"?client={client}" if client else ""
        self.control = await self._connect(f"/control{query}")
        self._tasks.append(asyncio.create_task(self._read_control()))
        self.id = (await self.event("introspection"))["data"]["client_id"]
        if stream:
            self.stream = await self._connect(f"/stream?client={self.id}")
            self._tasks.append(asyncio.create_task(self._read_stream()))
        return self

    def _connect(self, path):
        headers = self.headers
        return connect(
            f"ws://127.0.0.1:{self.port}{path}",
            additional_headers=headers,
            max_size=None,
            compression=None,
            proxy=None,
        )

    async def close(self):
        await self.control.close()
        if hasattr(self, "stream"):
            await self.stream.close()
        await asyncio.gather(*self._tasks)

    async def _read_control(self):
        async for text in _until_closed(self.control):
            message = json.loads(text) | {"at": time.monotonic()}
            async with self._changed:
                self.events.append(message)
                self._changed.notify_all()

    async def _read_stream(self):
        async for data in _until_closed(self.stream):
            frame = decode_frame(data)
            async with self._changed:
                self.frames.append((time.monotonic(), frame))
                self._changed.notify_all()

    async def until(self, condition, timeout_s=DEADLINE_S):
        try:
            async with asyncio.timeout(timeout_s), self._changed:
                await self._changed.wait_for(condition)
                return condition()
        except TimeoutError as error:
            last = [f"{e['command']} {e['data']}"[:300] for e in self.events[-LAST_EVENTS:]]
            raise TimeoutError(f"not in {timeout_s} s; the last events were: {last}") from error

    async def event(self, name, where=lambda data: True, *, after=0, timeout_s=DEADLINE_S):
        """Returns the first event of a name after the given place in `events`."""

        def find():
            return next((e for e in self.events[after:] if e["command"] == name and where(e["data"])), None)

        return await self.until(find, timeout_s)

    async def send(self, command, data=None):
        self._requests += 1
        request = f"c{self._requests}"
        await self.control.send(json.dumps({"id": request, "command": command, "data": data}))
        return request

    async def ask(self, command, data=None, timeout_s=DEADLINE_S):
        """Sends a command and returns its reply: "ack" or the error."""
        request = await self.send(command, data)
        reply = await self.until(
            lambda: next((e for e in self.events if e["id"] == request), None), timeout_s
        )
        return "ack" if reply["command"] == "ack" else reply["data"]

    def named(self, name, after=0):
        return [e["data"] for e in self.events[after:] if e["command"] == name]

    @property
    def state(self):
        states = [
            e["data"]["state"] for e in self.events if e["command"] in {"introspection", "state-changed"}
        ]
        return states[-1]

    async def comes_to(self, state):
        """Waits for a state, which the manager names after the event that led to it."""
        await self.until(lambda: self.state == state)

    def robot_position(self):
        """Returns the position of the first robot, from scene and poses."""
        scene = next((f for _, f in reversed(self.frames) if isinstance(f, Scene)), None)
        if scene is None:
            return None
        base = next(o for o in scene.objects if o.kind == "robot")
        position = base.pose[:3]
        for _, frame in self.frames:
            if isinstance(frame, Poses):
                ids = memoryview(frame.ids).cast("H")
                for i, object_id in enumerate(ids):
                    if object_id == base.id:
                        record = frame.poses[i * POSE_BYTES : (i + 1) * POSE_BYTES]
                        position = list(unpack(record)[:3])
        return position


async def _until_closed(socket):
    """Yields the messages of a socket until it is closed, in any way."""
    with contextlib.suppress(ConnectionClosed):
        async for message in socket:
            yield message


@contextlib.asynccontextmanager
async def manager_process(*arguments, env=None, prefix=()):
    """Runs a manager in a process of its own; afterwards nothing of it may be left.

    `prefix` is a command that runs another one in its own place.
    """
    reader, writer = os.pipe()
    process = await asyncio.create_subprocess_exec(
        *prefix,
        sys.executable,
        "-m",
        "executor.manager",
        "--port",
        "0",
        "--token-env",
        "TOKEN",
        "--ready-fd",
        str(writer),
        *arguments,
        pass_fds=[writer],
        cwd=ROOT,
        env={**os.environ, "TOKEN": TOKEN, **(env or {})},
    )
    os.close(writer)
    family = []
    try:
        with os.fdopen(reader) as ready:
            # Callers read it beside what a process has itself.
            process.ready = json.loads(await asyncio.to_thread(ready.readline))  # type: ignore[attr-defined]
        yield process
        with contextlib.suppress(psutil.NoSuchProcess):
            family = psutil.Process(process.pid).children(recursive=True)
    finally:
        if process.returncode is None:
            process.terminate()
        async with asyncio.timeout(DEADLINE_S):
            await process.wait()
        _, alive = psutil.wait_procs(family, timeout=DEADLINE_S)
        assert alive == []
