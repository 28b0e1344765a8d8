"""Runs a project in real time through a manager, without a browser, and measures what comes of it."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import io
import math
import secrets
import time
import zipfile
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

import msgspec
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

from executor import messages
from executor.headless.recording import Recording
from executor.headless.report import NodeCount, Report, quantiles
from executor.manager.manager import Manager, ManagerSettings
from executor.stream.pose_codec import POSE_BYTES, unpack
from executor.universes import BUILTIN_IDS, builtin_path

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from translator import Project

__all__ = ["HeadlessError", "HeadlessOptions", "run_headless"]

TRAJECTORY_HZ: Final = 10.0
_decode_frame = msgspec.msgpack.Decoder(
    messages.Scene | messages.Poses | messages.Scan | messages.Camera | messages.View
).decode


class HeadlessError(Exception):
    """The session refused to run; the text says why."""


@dataclass(frozen=True)
class HeadlessOptions:
    """How to run; None leaves it to the project."""

    universe: str | None = None
    seed: int = 0
    duration_s: float | None = None
    robot: str | None = None
    recording: Path | None = None


@dataclass
class _Measured:
    """What the events and frames of a run add up to."""

    report: Report = field(default_factory=Report)
    period_ms: float = 50.0
    finished: bool = False
    _paths: dict[int, NodeCount] = field(default_factory=dict)
    _running: set[int] = field(default_factory=set)
    _durations_s: list[float] = field(default_factory=list)
    _base: int = -1
    _start_s: float | None = None

    def take_event(self, name: str, data: dict[str, Any], time_s: float) -> None:
        report = self.report
        match name:
            case "tree":
                self._paths = {node["uid"]: NodeCount(node["path"]) for node in data["nodes"]}
                report.nodes = list(self._paths.values())
            case "tick":
                self._take_tick(data, time_s)
            case "sim":
                report.distance_m, report.collisions = data["distance_m"], data["collisions"]
            case "fault":
                report.errors.append(data)
            case "finished":
                report.root_status, self.finished = data["status"], True
            case _:
                pass

    def _take_tick(self, data: dict[str, Any], time_s: float) -> None:
        ticks = data["n"] - self.report.ticks
        self.report.ticks = data["n"]
        self._start_s = time_s if self._start_s is None else self._start_s
        self.report.sim_time_s = time_s - self._start_s
        self._durations_s.append(data["duration_ms"] / 1000.0)
        for uid, status in data["changed"]:
            (self._running.add if status == "RUNNING" else self._running.discard)(uid)
        for uid in self._running:
            self._paths[uid].ticks += ticks
            self._paths[uid].running += ticks
        for uid, status in data["changed"] + data["flashed"]:
            node = self._paths[uid]
            node.success += status == "SUCCESS"
            node.failure += status == "FAILURE"
            node.ticks += status in {"SUCCESS", "FAILURE"}

    def take_frame(self, frame: object) -> None:
        match frame:
            case messages.Scene():
                robots = (o.id for o in frame.objects if o.kind == "robot")
                self._base = next(robots, -1)
            case messages.Poses():
                ids = list(memoryview(frame.ids).cast("H"))
                if self._base in ids:
                    at = ids.index(self._base) * POSE_BYTES
                    pose = unpack(frame.poses[at : at + POSE_BYTES])
                    self.report.trajectory.append(_trajectory_point(frame.t, pose))
            case messages.Scan():
                ranges = [r for r in memoryview(frame.ranges).cast("f") if math.isfinite(r) and r > 0]
                nearest = [*ranges, *([] if self.report.min_range_m is None else [self.report.min_range_m])]
                self.report.min_range_m = min(nearest, default=None)
            case _:
                pass

    def end(self, wall_time_s: float) -> Report:
        report = self.report
        if not report.root_status or report.root_status == "IDLE":
            report.root_status = "RUNNING" if min(self._paths, default=0) in self._running else "IDLE"
        report.wall_time_s = wall_time_s
        report.real_time_factor = report.sim_time_s / wall_time_s if wall_time_s > 0 else 0.0
        report.tick_ms = quantiles(self._durations_s)
        report.overruns = sum(d * 1000.0 > self.period_ms for d in self._durations_s)
        return report


def _trajectory_point(time_s: float, pose: Sequence[float]) -> list[float]:
    x, y, _, qx, qy, qz, qw = pose
    yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
    return [round(v, 4) for v in (time_s, x, y, yaw)]


def run_headless(
    project: Project,
    app_zip: bytes,
    options: HeadlessOptions,
    *,
    progress: Callable[[Report], None],
    say: Callable[[str], None],
) -> Report:
    """Runs a project until its tree ends, the time is over, or it is interrupted.

    Args:
        project: for its settings and universes.
        app_zip: the same project, packed.
        options: what differs from its settings.
        progress: called about once a second.
        say: called with each line that the actions print.

    Raises:
        HeadlessError: the world or the application cannot be started.
    """
    return asyncio.run(_run(project, app_zip, options, progress, say))


async def _run(
    project: Project,
    app_zip: bytes,
    options: HeadlessOptions,
    progress: Callable[[Report], None],
    say: Callable[[str], None],
) -> Report:
    token = secrets.token_urlsafe()
    manager = Manager(ManagerSettings(port=0, token=token))
    try:
        port = await manager.start()
        url, headers = f"ws://127.0.0.1:{port}", {"Authorization": f"Bearer {token}"}
        more: dict[str, Any] = {"max_size": None, "compression": None, "proxy": None}
        async with connect(f"{url}/control", additional_headers=headers, **more) as control:
            introspection = msgspec.json.decode(await control.recv())["data"]
            stream_url = f"{url}/stream?client={introspection['client_id']}"
            async with connect(stream_url, additional_headers=headers, **more) as stream:
                with _recording(project, options) as recording:
                    runner = _Runner(control, stream, project.settings.tick_hz, say, recording)
                    data = _run_data(project, app_zip, options)
                    return await runner.run(data, options.duration_s, progress)
    finally:
        await manager.close()


def _recording(
    project: Project, options: HeadlessOptions
) -> contextlib.AbstractContextManager[Recording | None]:
    if options.recording is None:
        return contextlib.nullcontext()
    universe = options.universe or project.settings.universe
    about = {"project": project.settings.name, "universe": universe, "seed": options.seed}
    try:
        return Recording(options.recording, about)
    except OSError as error:
        raise HeadlessError(f"{options.recording}: cannot be written: {error.strerror}") from error


class _Runner:
    """The client's side of the session."""

    def __init__(
        self,
        control: ClientConnection,
        stream: ClientConnection,
        tick_hz: float,
        say: Callable[[str], None],
        recording: Recording | None,
    ) -> None:
        self._control = control
        self._stream = stream
        self._say = say
        self._recording = recording
        self._measured = _Measured(period_ms=1000.0 / tick_hz)
        self._replies: dict[str, asyncio.Future[dict[str, Any]]] = {}
        self._changed = asyncio.Event()

    async def run(
        self, data: dict[str, Any], duration_s: float | None, progress: Callable[[Report], None]
    ) -> Report:
        readers = [asyncio.create_task(self._read_control()), asyncio.create_task(self._read_stream())]
        try:
            for stream in ("poses", "scan"):
                await self._ask("subscribe", {"stream": stream, "max_hz": TRAJECTORY_HZ})
            await self._ask("run", data)
            began_s = time.monotonic()
            with contextlib.suppress(asyncio.CancelledError):  # Ctrl-C ends the run, not the report
                await self._follow(duration_s, progress)
            return self._measured.end(time.monotonic() - began_s)
        finally:
            # The readers go on until both are closed: unread frames would keep the close from being seen.
            await asyncio.gather(self._stream.close(), self._control.close(), *readers)

    async def _follow(self, duration_s: float | None, progress: Callable[[Report], None]) -> None:
        measured, told_s = self._measured, 0.0
        while not measured.finished and (duration_s is None or measured.report.sim_time_s < duration_s):
            self._changed.clear()
            await self._changed.wait()
            if time.monotonic() - told_s >= 1.0:
                told_s = time.monotonic()
                progress(measured.report)

    async def _ask(self, command: str, data: dict[str, Any]) -> None:
        reply = self._replies[command] = asyncio.get_running_loop().create_future()
        await self._control.send(
            msgspec.json.encode({"id": command, "command": command, "data": data}).decode()
        )
        answer = await reply
        if answer["command"] == "error":
            error = answer["data"]
            raise HeadlessError(_located(error, self._measured.report.errors))

    async def _read_control(self) -> None:
        with contextlib.suppress(ConnectionClosed):
            async for text in self._control:
                message = msgspec.json.decode(text)
                if self._recording is not None:
                    self._recording.event(message)
                name, data = message["command"], message["data"]
                reply = self._replies.pop(message["id"], None)
                if reply is not None:
                    reply.set_result(message)
                elif name == "log" and data["source"] == "action":
                    self._say(data["text"])
                else:
                    self._measured.take_event(name, data, message["t"])
                self._changed.set()
        self._measured.finished = True
        self._changed.set()

    async def _read_stream(self) -> None:
        with contextlib.suppress(ConnectionClosed):
            async for data in self._stream:
                if isinstance(data, bytes):
                    frame = _decode_frame(data)
                    self._measured.take_frame(frame)
                    if self._recording is not None:
                        self._recording.frame(frame)


def _located(error: dict[str, Any], faults: list[dict[str, Any]]) -> str:
    """Writes an error as `file:line:column: CODE message (hint)`, with the place of the fault behind it."""
    place = next((f"{f['file']}:{f['line']}:1: " for f in faults if f.get("file")), "")
    hint = f" ({error['hint']})" if error.get("hint") else ""
    return f"{place}{error['code']} {error['message']}{hint}"


def _run_data(project: Project, app_zip: bytes, options: HeadlessOptions) -> dict[str, Any]:
    settings = project.settings
    name = options.universe or settings.universe
    own = project.files.get(f"universes/{name}.yaml")
    universe: Any = name
    assets = {path: data for path, data in project.files.items() if path.startswith(("assets/", "robots/"))}
    if own is None and assets and name in BUILTIN_IDS:
        own = builtin_path(name).read_bytes()  # with the project's robots at hand
    if own is not None:
        universe = {"document": own.decode(), "assets_zip_base64": _zip_base64(assets) if assets else ""}
    return {
        "universe": {"universe": universe, "robot": options.robot or settings.robot, "seed": options.seed},
        "application": {
            "app_zip_base64": base64.b64encode(app_zip).decode(),
            "tick_hz": settings.tick_hz,
            "on_finish": settings.on_finish,
            "on_error": settings.on_error,
        },
    }


def _zip_base64(files: dict[str, bytes]) -> str:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in sorted(files.items()):
            archive.writestr(path, data)
    return base64.b64encode(packed.getvalue()).decode()
