"""A second client of a session, which measures what the world really did.

It joins as a viewer through the back end's own sockets, with the browser's cookie, and decodes every
message of both; so the figures of the tests come from true poses, not from the page.
"""

from __future__ import annotations

import itertools
import json
import math
import threading
import time
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from typing import Any, Self

import msgpack
import numpy as np
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from executor.stream.pose_codec import POSE_BYTES, unpack
from tests.e2e.server import DEADLINE_S

_ids = itertools.count(1)


@dataclass
class Observer:
    """The messages of a session, collected by two threads until `close`."""

    control: ClientConnection
    stream: ClientConnection
    sockets: ExitStack
    objects: dict[str, int] = field(default_factory=dict)
    poses: dict[int, list[tuple[float, np.ndarray]]] = field(default_factory=dict)
    events: list[dict[str, Any]] = field(default_factory=list)
    frames: dict[str, int] = field(default_factory=dict)
    frame_t: float = 0.0
    threads: list[threading.Thread] = field(default_factory=list)

    @classmethod
    def join(cls, origin: str, cookie: str, session_id: str) -> Self:
        """Joins session `session_id` of the server at `origin` and subscribes to its poses."""
        socket = origin.replace("http", "ws", 1) + f"/ws/sessions/{session_id}"
        headers = {"Cookie": cookie}
        sockets = ExitStack()

        def opened(path: str) -> ClientConnection:
            connection = connect(
                f"{socket}/{path}", additional_headers=headers, origin=Origin(origin), max_size=None
            )
            return sockets.enter_context(connection)

        control = opened("control")
        first = json.loads(control.recv(timeout=DEADLINE_S))
        assert first["command"] == "introspection", first
        client = first["data"]["client_id"]
        stream = opened(f"stream?client={client}")
        observer = cls(control, stream, sockets, events=[first])
        observer.threads = [
            threading.Thread(target=observer._read_control, daemon=True),
            threading.Thread(target=observer._read_stream, daemon=True),
        ]
        for thread in observer.threads:
            thread.start()
        observer.send("subscribe", {"stream": "poses", "max_hz": 30})
        return observer

    def send(self, command: str, data: dict[str, Any] | None = None) -> str:
        """Sends a command and returns its id."""
        message_id = f"observer-{next(_ids)}"
        self.control.send(json.dumps({"id": message_id, "command": command, "data": data or {}}))
        return message_id

    def close(self) -> None:
        """Leaves the session."""
        self.sockets.close()
        for thread in self.threads:
            thread.join(timeout=5)

    def of(self, command: str) -> list[dict[str, Any]]:
        """Returns the events of one kind so far, oldest first."""
        return [event for event in list(self.events) if event["command"] == command]

    def sim_time(self) -> float:
        """Returns the newest simulated time in s."""
        return max(self.frame_t, *(float(event["t"]) for event in list(self.events)[-200:]))

    def track(self, body: str) -> list[tuple[float, float, float]]:
        """Returns the positions of a body: (t in s, x and y in m) by time."""
        return [
            (t, float(p[0]), float(p[1])) for t, p in list(self.poses.get(self.objects.get(body, -1), []))
        ]

    def distance_travelled(self, body: str) -> float:
        """Returns the length in m of a body's path."""
        track = self.track(body)
        return sum(math.dist(a[1:], b[1:]) for a, b in itertools.pairwise(track))

    def wait_for_sim_time(self, t: float, deadline_s: float = DEADLINE_S) -> None:
        """Waits until the simulated time is at least `t` s."""
        end = time.monotonic() + deadline_s
        while self.sim_time() < t:
            assert time.monotonic() < end, f"simulated time stands at {self.sim_time():.1f} s, not {t:.1f} s"
            time.sleep(0.1)

    def _read_control(self) -> None:
        with suppress(ConnectionClosed):
            for text in self.control:
                self.events.append(json.loads(text))

    def _read_stream(self) -> None:
        with suppress(ConnectionClosed):
            for data in self.stream:
                frame = msgpack.unpackb(data)
                self.frames[frame["type"]] = self.frames.get(frame["type"], 0) + 1
                self.frame_t = max(self.frame_t, frame["t"])
                if frame["type"] == "scene":
                    self._take_scene(frame)
                elif frame["type"] == "poses":
                    self._take_poses(frame)

    def _take_scene(self, scene: dict[str, Any]) -> None:
        for item in scene["objects"]:
            self.objects.setdefault(item["body"], item["id"])
            self.poses.setdefault(item["id"], []).append((scene["t"], np.array(item["pose"])))

    def _take_poses(self, frame: dict[str, Any]) -> None:
        ids = np.frombuffer(frame["ids"], "<u2")
        records = [frame["poses"][at : at + POSE_BYTES] for at in range(0, len(frame["poses"]), POSE_BYTES)]
        poses = [np.array(unpack(record), np.float32) for record in records]
        for object_id, pose in zip(ids.tolist(), poses, strict=True):
            self.poses.setdefault(object_id, []).append((frame["t"], pose))
