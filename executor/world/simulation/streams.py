"""Sends streams to clients, each at its requested rate.

The scene is sent first, then only poses that changed. Nothing is sent twice: of a paused world, only data
that a new or changed subscription has not received yet are sent.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

import msgspec
import numpy as np

from executor.child_messages import Frame
from executor.messages import Camera, CameraPose, Poses, Scan, StreamName, View
from executor.render.interface import look_at
from executor.render.jpeg import to_jpeg
from executor.stream.pose_codec import pack
from executor.world.sensing.cameras import find_camera
from executor.world.simulation.adaptation import LEVELS, Adaptation, Level, ViewSize

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from msgspec import Struct
    from numpy.typing import NDArray

    from executor.world.interface import World
    from executor.world.sensing.sensors import Sensors

    Send = Callable[[Frame], None]

MAX_HZ: Final[dict[str, float]] = {"poses": 60.0, "scan": 30.0, "camera": 30.0, "view": 30.0}
PICTURES: Final = ("camera", "view")
REST_SHARE: Final = 0.25
"""Pause between two pictures, as a share of the time that the first one took."""
MOVED_M: Final = 1e-4
VIEW_WIDTH: Final = 960
WIDTHS: Final = (64, 1920)
VIEW_FOV: Final = 1.05
DEFAULT_VIEW: Final = CameraPose((-4.5, -5.0, 4.5), (0.0, 0.0, 0.2))

_encode = msgspec.msgpack.Encoder().encode


@dataclass
class Subscription:
    """One stream of one client, and its last frame. `sensor` names a camera, "" the first one."""

    client: str | None
    stream: StreamName
    sensor: str
    max_hz: float
    width: int | None
    camera_pose: CameraPose
    next_s: float = 0.0
    seen: Any = None
    poses: NDArray[np.float32] | None = field(default=None, repr=False)
    size: ViewSize = field(default_factory=ViewSize)


class Streams:
    """All subscriptions of a world. `send` is called with each frame."""

    def __init__(
        self, world: World, sensors: Sensors, send: Send, *, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._world = world
        self._sensors = sensors
        self._send = send
        self._clock = clock
        self._rests_until_s = -math.inf
        self.camera_share = 1.0
        """Share of their rates at which cameras draw."""
        self._subscriptions: dict[tuple[str | None, str, str], Subscription] = {}
        self._adaptations: dict[str | None, Adaptation[Level]] = {}
        self._encoded: tuple[NDArray[np.uint8] | None, int, bytes] = (None, 0, b"")

    @property
    def has_camera(self) -> bool:
        """Whether a client subscribes to a camera."""
        return any(stream == "camera" for _, stream, _ in self._subscriptions)

    def __len__(self) -> int:
        return len(self._subscriptions)

    def subscribe(  # noqa: PLR0913 - the wishes of one message
        self,
        client: str | None,
        stream: StreamName,
        *,
        max_hz: float = 30.0,
        width: int | None = None,
        camera_pose: CameraPose | None = None,
        sensor: str = "",
    ) -> None:
        """Starts a stream of a client, or changes it. Each camera is a separate stream."""
        rate = min(max(max_hz, 0.1), MAX_HZ[stream])
        wide = None if width is None else min(max(width, WIDTHS[0]), WIDTHS[1])
        old = self._subscriptions.get((client, stream, sensor))
        view = camera_pose or (old.camera_pose if old else DEFAULT_VIEW)
        new = Subscription(client, stream, sensor, rate, wide, view)
        if old is not None:
            # The scene is unchanged, so it is not sent to the client again.
            new.next_s, new.poses, new.size = old.next_s, old.poses, old.size
        self._subscriptions[client, stream, sensor] = new

    def unsubscribe(self, client: str | None, stream: str, *, sensor: str = "") -> None:
        """Ends a stream of a client, if it exists."""
        self._subscriptions.pop((client, stream, sensor), None)
        if not any(one.client == client for one in self._subscriptions.values()):
            self._adaptations.pop(client, None)

    def clear(self) -> None:
        """Ends all streams."""
        self._subscriptions.clear()
        self._adaptations.clear()

    def pace(self, client: str | None, lost: float) -> None:
        """Adapts a client's pictures to the share of them for which the client was too slow.

        Called about twice a second.
        """
        if any(one.client == client for one in self._subscriptions.values()):
            self._adaptations.setdefault(client, Adaptation(LEVELS)).note(lost)

    def scene_changed(self) -> None:
        """Sends the scene again to all clients with poses."""
        for subscription in self._subscriptions.values():
            subscription.poses, subscription.seen = None, None

    def next_due_s(self, now_s: float) -> float:
        """Returns the seconds until a frame may be due."""
        return max(0.0, min((s.next_s - now_s for s in self._subscriptions.values()), default=1.0))

    def send_due(self, now_s: float) -> None:
        """Sends the frames that are due. After a slow picture, the world gets time for its steps first."""
        may_draw, drawing_s = now_s >= self._rests_until_s, 0.0
        for subscription in list(self._subscriptions.values()):
            is_picture = subscription.stream in PICTURES
            if now_s < subscription.next_s or (is_picture and not may_draw):
                continue
            began_s = self._clock()
            if self._send_one(subscription):
                period = 1.0 / (subscription.max_hz * self._rate_share(subscription))
                # The due times stay in phase unless far behind, so that a 30 Hz stream of a 60 Hz world does
                # not jitter.
                subscription.next_s = max(subscription.next_s + period, now_s - period)
                if subscription.stream == "view":
                    subscription.size.sent(now_s, period, self._sensors.version)
            drawing_s += is_picture * (self._clock() - began_s)
        if drawing_s:
            self._rests_until_s = now_s + drawing_s * (1 + REST_SHARE)

    def _send_one(self, subscription: Subscription) -> bool:
        if subscription.stream == "poses":
            return self._send_poses(subscription)
        sample = self._sample(subscription)
        if sample is None or sample == subscription.seen:
            return False
        frame = self._frame(subscription)
        if frame is not None:
            self._emit(subscription, frame)
        subscription.seen = sample
        return True

    def _sample(self, subscription: Subscription) -> object:
        """Returns a value that identifies the measurement of a frame.

        It changes at most at the rate of the sensor.
        """
        if subscription.stream == "view":
            return self._sensors.version
        rate_hz = self._rate_hz(subscription)
        return None if rate_hz is None else int(self._world.time_s * rate_hz + 1e-6)

    def _rate_hz(self, subscription: Subscription) -> float | None:
        """Returns the rate of a subscription's sensor, or None if the world has no such sensor."""
        if subscription.stream == "camera":
            found = find_camera(self._world, subscription.sensor)
            return None if found is None else found[2].rate_hz * self.camera_share
        lidars = [lidar for robot in self._world.robots[:1] for lidar in robot.config.lidars]
        return lidars[0].rate_hz if lidars else None

    def _frame(self, subscription: Subscription) -> Struct | None:
        if subscription.stream == "view":
            return self._view(subscription)
        if subscription.stream == "scan":
            robot = self._world.robots[0]
            lidar = robot.config.lidars[0]
            reading = self._sensors.scan(robot, lidar)
            return Scan(
                t=reading.time_s,
                sensor=lidar.name,
                pose=list(reading.pose),
                angle_min=lidar.angle_min,
                angle_increment=lidar.angle_increment,
                range_max=lidar.range_max,
                ranges=reading.ranges.astype("<f4").tobytes(),
            )
        return self._camera(subscription)

    def _camera(self, subscription: Subscription) -> Camera | None:
        found = find_camera(self._world, subscription.sensor)
        if found is None:
            return None
        name, robot, camera = found
        level = self._level(subscription.client)
        wide = max(WIDTHS[0], round((subscription.width or camera.width) * level.width))
        picture = self._sensors.picture(robot, camera, wide)
        height, width = picture.shape[:2]
        return Camera(
            t=self._world.time_s,
            sensor=name,
            width=width,
            height=height,
            jpeg=self._sensors.jpeg(robot, camera, wide, level.quality),
        )

    def _view(self, subscription: Subscription) -> View:
        level = self._level(subscription.client)
        # Sizes are multiples of 16 pixels, the blocks of JPEG, so that few sizes of framebuffers exist.
        share = min(level.width, subscription.size.share)
        width = max(WIDTHS[0], round((subscription.width or VIEW_WIDTH) * share / 16) * 16)
        height = round(width * 9 / 16)
        pose = subscription.camera_pose
        picture = self._sensors.view(look_at(pose.eye, pose.target, VIEW_FOV), width, height)
        jpeg = self._jpeg_once(picture, level.quality)
        return View(t=self._world.time_s, width=width, height=height, jpeg=jpeg)

    def _jpeg_once(self, picture: NDArray[np.uint8], quality: int) -> bytes:
        """Encodes a picture as JPEG; for the same picture as before it returns the same bytes."""
        known, of_quality, jpeg = self._encoded
        if picture is not known or quality != of_quality:
            jpeg = to_jpeg(picture, quality)
            self._encoded = (picture, quality, jpeg)
        return jpeg

    def _level(self, client: str | None) -> Level:
        adaptation = self._adaptations.get(client)
        return LEVELS[0] if adaptation is None else adaptation.level

    def _rate_share(self, subscription: Subscription) -> float:
        return self._level(subscription.client).rate if subscription.stream in PICTURES else 1.0

    def _send_poses(self, subscription: Subscription) -> bool:
        poses = self._world.poses()
        old = subscription.poses
        if old is None:
            self._emit(subscription, self._world.scene, stream="scene", keep=True)
            changed: Iterable[int] = range(len(poses))
            subscription.poses = poses.copy()
        else:
            moved = np.flatnonzero(np.abs(poses - old).max(axis=1, initial=0.0) > MOVED_M)
            if not len(moved):
                return False
            old[moved] = poses[moved]
            changed = moved.tolist()
        rows = np.fromiter(changed, np.uint16)
        self._emit(
            subscription,
            Poses(
                t=self._world.time_s,
                ids=rows.astype("<u2").tobytes(),
                poses=pack(poses[rows]),
            ),
        )
        return True

    def _emit(
        self, subscription: Subscription, frame: Struct, *, stream: str = "", keep: bool = False
    ) -> None:
        lane: str = subscription.stream
        if subscription.sensor:
            # A picture of one camera must not replace a waiting one of another.
            lane = f"{lane}/{subscription.sensor}"
        self._send(Frame(subscription.client, stream or lane, _encode(frame), keep))
