"""Streams of whole sessions, in `warehouse`: bytes, latency, memory, and many sessions side by side.

Each session is a manager in a process of its own with its world and its application; the clients are sockets
in this process that decode every message.
"""

from __future__ import annotations

import asyncio
import contextlib
import statistics
import time
from typing import TYPE_CHECKING, Any

import psutil

from executor.messages import Camera, Poses, View
from tests.benchmarks.timing import pss_mb
from tests.executor.session_client import SessionClient, app_zip, manager_process, run_data

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

UNIVERSE = "warehouse"
WATCHED_S = 10.0
SESSIONS = (1, 6, 10)
SETTLED_S = 40.0
SIDE_BY_SIDE_S = 20.0
TURNS = 12
IDLE = """
import py_trees


class {name}(py_trees.behaviour.Behaviour):
    def update(self):
        return py_trees.common.Status.RUNNING
"""
Session = tuple[Any, SessionClient]


def main() -> None:
    """Prints every figure."""
    asyncio.run(_main())


async def _main() -> None:
    await sizes()
    await views()
    await latency()
    for count in SESSIONS:
        await side_by_side(count)


@contextlib.asynccontextmanager
async def session(app: str, *streams: dict[str, Any], universe: str = UNIVERSE) -> AsyncIterator[Session]:
    """Runs a session with one client that subscribes to some streams."""
    async with manager_process() as process:
        client = await SessionClient(process.ready["port"]).open()
        for stream in streams:
            await client.ask("subscribe", stream)
        answer = await client.ask("run", run_data(app, universe=universe))
        if answer != "ack":
            raise RuntimeError(f"the session does not run: {answer}")
        yield process, client
        await client.ask("disconnect")
        await client.close()


async def sizes() -> None:
    """Bytes a second of the 3D stream, and of the same view as pictures."""
    view = {"stream": "view", "max_hz": 30.0, "width": 1280}
    async with session(app_zip(), {"stream": "poses", "max_hz": 30.0}, view) as (_, client):
        await asyncio.sleep(3)
        first = len(client.frames)
        await asyncio.sleep(WATCHED_S)
        frames = [frame for _, frame in client.frames[first:]]
        poses = [len(frame.ids) + len(frame.poses) + 24 for frame in frames if isinstance(frame, Poses)]
        pictures = [len(frame.jpeg) + 40 for frame in frames if isinstance(frame, View)]
        in_3d, in_2d = sum(poses) / WATCHED_S, sum(pictures) / WATCHED_S
        print(
            f"3D stream {in_3d / 1000:.1f} kB/s at {len(poses) / WATCHED_S:.0f} Hz, "
            f"the same view of 1280x720 as JPEG {in_2d / 1000:.0f} kB/s "
            f"at {len(pictures) / WATCHED_S:.1f} Hz: "
            f"{statistics.mean(pictures) / statistics.mean(poses):.0f} times as many a frame"
        )


async def views() -> None:
    """The server's own view of 1280×720 from above the hall, while the robot and two people move in it."""
    above = {"eye": [-14.71, -20.79, 14.51], "target": [-3.04, -4.48, 0.2]}
    wanted = {"stream": "view", "max_hz": 30.0, "width": 1280, "camera_pose": above}
    async with session(app_zip(), wanted) as (_, client):
        await asyncio.sleep(5)
        first, sim = len(client.frames), client.events[-1]["t"]
        began_s = time.monotonic()
        await asyncio.sleep(WATCHED_S)
        passed_s = time.monotonic() - began_s
        pictures = [frame for _, frame in client.frames[first:] if isinstance(frame, View)]
        print(
            f"server's own view: {len(pictures) / passed_s:.1f} pictures a second, "
            f"{statistics.mean(picture.width for picture in pictures):.0f} pixels wide on average, "
            f"real-time factor {(client.events[-1]['t'] - sim) / passed_s:.2f}"
        )


async def latency() -> None:
    """Measures the time from a client's command to its first picture that shows the effect."""
    app = app_zip(**{name: IDLE.format(name=name) for name in ("Forward", "Turn")})
    for stream, kind in (("view", View), ("camera", Camera)):
        wanted = {"stream": stream, "max_hz": 30.0}
        async with session(app, wanted, universe="walled_room") as (_, client):
            await asyncio.sleep(2)
            delays = [await _delay_s(client, kind, turn) for turn in range(TURNS)]
        delays.sort()
        worst = delays[round(0.95 * (len(delays) - 1))]
        print(
            f"command to pixel by {stream}: median {statistics.median(delays) * 1000:.0f} ms, "
            f"p95 {worst * 1000:.0f} ms"
        )


async def _delay_s(client: SessionClient, kind: type[View] | type[Camera], turn: int) -> float:
    await client.send("teleop", {"linear": 0.0, "angular": 0.0})
    await asyncio.sleep(1.2 + 0.013 * turn)  # at any phase of the camera
    client.frames.clear()
    await client.until(lambda: sum(isinstance(f, kind) for _, f in client.frames) >= 2)
    still = next(f.jpeg for _, f in reversed(client.frames) if isinstance(f, kind))
    client.frames.clear()
    began_s = time.monotonic()
    await client.send("teleop", {"linear": 0.3, "angular": 2.0 if turn % 2 else -2.0})

    def first() -> float | None:
        seen = ((at, f.jpeg) for at, f in client.frames if isinstance(f, kind))
        return next((at - began_s for at, jpeg in seen if jpeg != still), None)

    delay_s: float = await client.until(first)
    return delay_s


async def side_by_side(count: int) -> None:
    """Real-time factor and memory of sessions with their camera in use and one 3D viewer each.

    On a machine too small for all of them the cameras yield to time; they are given the time to find out.
    """
    app = app_zip("visual_follow_person")
    async with contextlib.AsyncExitStack() as stack:
        sessions = []
        for _ in range(count):
            made = session(app, {"stream": "poses", "max_hz": 30.0})
            sessions.append(await stack.enter_async_context(made))
        await asyncio.sleep(SETTLED_S)
        before = [client.events[-1]["t"] for _, client in sessions]
        began_s = time.monotonic()
        await asyncio.sleep(SIDE_BY_SIDE_S)
        passed_s = time.monotonic() - began_s
        factors = [
            (client.events[-1]["t"] - t) / passed_s for (_, client), t in zip(sessions, before, strict=True)
        ]
        shares = [_last_sim(client)["camera_share"] for _, client in sessions]
        memory = [pss_mb(process.pid) for process, _ in sessions]
        load = psutil.cpu_percent(0.5) * psutil.cpu_count() / 100
        print(
            f"{count} session{'s' if count > 1 else ''} with camera and one 3D viewer: "
            f"real-time factor {min(factors):.3f} to {max(factors):.3f}, "
            f"cameras at {min(shares):.0%} to {max(shares):.0%} of their rates, "
            f"{max(memory):.0f} MB (PSS) the largest, {sum(memory):.0f} MB all, "
            f"{load:.1f} cores busy"
        )


def _last_sim(client: SessionClient) -> dict[str, Any]:
    return dict(next(event["data"] for event in reversed(client.events) if event["command"] == "sim"))


if __name__ == "__main__":
    main()
