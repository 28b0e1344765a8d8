"""Runs a project in real time through a manager, without a browser, and measures it."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import io
import secrets
import time
import zipfile
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import msgspec
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

from executor import messages
from executor.headless.errors import HeadlessError
from executor.headless.lines import mismatch_line
from executor.headless.measured import Measured
from executor.headless.recorded_segments import recorded_segments
from executor.manager.manager import Manager, ManagerSettings
from executor.universes import BUILTIN_IDS, builtin_path
from executor.universes.document import text_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from executor.headless.report import Report
    from translator import Project

__all__ = ["HeadlessError", "HeadlessOptions", "run_headless"]

TRAJECTORY_HZ: Final = 10.0
_decode_frame: Final = msgspec.msgpack.Decoder(
    messages.Scene | messages.Poses | messages.Scan | messages.Camera | messages.View | messages.RecordingPart
).decode
LOOK_EVERY_S: Final = 1.0
HANGS_AFTER_S: Final = 6.0
"""Seconds after the fault until a tick counts as hung; a tick that is only slow has returned by then."""


@dataclass(frozen=True)
class HeadlessOptions:
    """Options of a run; None means the project's setting."""

    universe: str | None = None
    seed: int = 0
    duration_s: float | None = None
    robot: str | None = None
    recording: Path | None = None
    profile: bool = False
    groot2: int = 0


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
        project: the project, with its settings and universes.
        app_zip: the same project, packed.
        options: replace settings of the project.
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
    keeping = contextlib.nullcontext() if options.recording is None else recorded_segments(options.recording)
    with keeping as folder:
        token = secrets.token_urlsafe()
        settings = ManagerSettings(
            port=0,
            token=token,
            records=folder is not None,
            recordings=folder,
            keeps_whole=True,
            groot2=options.groot2,
        )
        manager = Manager(settings)
        try:
            port = await manager.start()
            url, headers = f"ws://127.0.0.1:{port}", {"Authorization": f"Bearer {token}"}
            more: dict[str, Any] = {"max_size": None, "compression": None, "proxy": None}
            async with connect(f"{url}/control", additional_headers=headers, **more) as control:
                introspection = msgspec.json.decode(await control.recv())["data"]
                stream_url = f"{url}/stream?client={introspection['client_id']}"
                async with connect(stream_url, additional_headers=headers, **more) as stream:
                    runner = _Runner(control, stream, project, say)
                    data = _run_data(project, app_zip, options)
                    return await runner.run(data, options, progress)
        finally:
            await manager.close()


class _Runner:
    """The client side of the session."""

    def __init__(
        self,
        control: ClientConnection,
        stream: ClientConnection,
        project: Project,
        say: Callable[[str], None],
    ) -> None:
        settings = project.settings
        self._files = project.files
        self._control = control
        self._stream = stream
        self._say = say
        self._measured = Measured(period_ms=1000.0 / settings.tick_hz)
        self._started: set[str] = set()
        self._replies: dict[str, asyncio.Future[dict[str, Any]]] = {}
        self._changed = asyncio.Event()
        self._hangs_s: float | None = None
        """Since when no tick has been done."""

    async def run(
        self, data: dict[str, Any], options: HeadlessOptions, progress: Callable[[Report], None]
    ) -> Report:
        readers = [asyncio.create_task(self._read_control()), asyncio.create_task(self._read_stream())]
        try:
            for stream in ("poses", "scan"):
                await self._ask("subscribe", {"stream": stream, "max_hz": TRAJECTORY_HZ})
            if options.profile:
                await self._ask("profile", {"on": True})
            await self._ask("run", data)
            self._forget_slow_loading()
            began_s = time.monotonic()
            with contextlib.suppress(asyncio.CancelledError):  # Ctrl-C ends the run, not the report
                await self._follow(options.duration_s, progress)
            return self._measured.end(time.monotonic() - began_s)
        finally:
            # The readers run until both sockets are closed: unread frames would hide the end of the
            # connection.
            await asyncio.gather(self._stream.close(), self._control.close())
            await asyncio.gather(*readers)

    def _forget_slow_loading(self) -> None:
        """Removes the faults about slow loading, after the application has loaded."""
        errors, self._hangs_s = self._measured.report.errors, None
        errors[:] = [error for error in errors if error["kind"] != "timeout"]

    async def _follow(self, duration_s: float | None, progress: Callable[[Report], None]) -> None:
        measured, told_s = self._measured, 0.0
        while not measured.finished and (duration_s is None or measured.report.sim_time_s < duration_s):
            self._changed.clear()
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), LOOK_EVERY_S)
            if self._hangs_s is not None and time.monotonic() - self._hangs_s >= HANGS_AFTER_S:
                return  # the report has the fault and its place
            if time.monotonic() - told_s >= 1.0:
                told_s = time.monotonic()
                progress(measured.report)

    async def _send(self, request: str, command: str, data: dict[str, Any]) -> None:
        text = msgspec.json.encode({"id": request, "command": command, "data": data}).decode()
        await self._control.send(text)

    async def _ask(self, command: str, data: dict[str, Any]) -> None:
        reply = self._replies[command] = asyncio.get_running_loop().create_future()
        await self._send(command, command, data)
        answer = await reply
        if answer["command"] == "error":
            error = answer["data"]
            raise HeadlessError(_located(error, self._measured.report.errors))

    async def _read_control(self) -> None:
        try:
            async for text in self._control:
                self._take(msgspec.json.decode(text))
                self._changed.set()
        except ConnectionClosed:
            pass
        finally:  # also if the output is closed
            self._measured.finished = True
            self._changed.set()

    def _take(self, message: dict[str, Any]) -> None:
        name, data = message["command"], message["data"]
        reply = self._replies.pop(message["id"], None)
        if reply is not None:
            reply.set_result(message)
        elif name == "log" and data["source"] == "action":
            is_about = data["level"] == "warning" and data["node_path"]
            self._say(f"{data['node_path']}: {data['text']}" if is_about else data["text"])
        elif name == "log" and data["source"] == "launch":
            is_placed = data["text"].startswith("launch/")
            self._say(data["text"] if is_placed else f"[{data['launch_node']}] {data['text']}")
        elif name == "launch_nodes":
            self._say_started(data["nodes"])
        elif name == "topic_mismatch":
            if not data["resolved"]:
                self._say(mismatch_line(data["topic"], data["message"], data["hint"], self._files))
        else:
            if name == "fault" and data["kind"] == "timeout":
                self._hangs_s = time.monotonic()
            elif name == "tick":
                self._hangs_s = None
            self._measured.take_event(name, data, message["t"])

    def _say_started(self, nodes: list[dict[str, Any]]) -> None:
        """Names each launch node at its start."""
        for node in nodes:
            if node["state"] == "running" and node["id"] not in self._started:
                self._started.add(node["id"])
                self._say(f"{node['file']}:{node['line']}: the launch node {node['name']} is started")

    async def _read_stream(self) -> None:
        with contextlib.suppress(ConnectionClosed):
            async for data in self._stream:
                if isinstance(data, bytes):
                    self._measured.take_frame(_decode_frame(data))


def _located(error: dict[str, Any], faults: list[dict[str, Any]]) -> str:
    """Returns an error as `file:line:column: CODE message (hint)`, with the file and line of the fault."""
    place = next((f"{f['file']}:{f['line']}:1: " for f in faults if f.get("file")), "")
    hint = f" ({error['hint']})" if error.get("hint") else ""
    return f"{place}{error['code']} {error['message']}{hint}"


def _run_data(project: Project, app_zip: bytes, options: HeadlessOptions) -> dict[str, Any]:
    settings = project.settings
    name = options.universe or settings.universe
    path = f"universes/{name}.yaml"
    own = project.files.get(path)
    universe: Any = name
    assets = {path: data for path, data in project.files.items() if path.startswith(("assets/", "robots/"))}
    if own is None and assets and name in BUILTIN_IDS:
        own = builtin_path(name).read_bytes()  # so that the project's robots are found
    if own is not None:
        packed = _zip_base64(assets) if assets else ""
        universe = {"document": text_of(own, path), "assets_zip_base64": packed, "file": path}
    return {
        "universe": {
            "universe": universe,
            "robot": options.robot or settings.robot,
            "seed": options.seed,
            "time": settings.time,
        },
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
