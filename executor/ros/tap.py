"""Takes the messages of topics for a recording, as CDR; pictures become JPEG, at most ten in a second."""

from __future__ import annotations

import functools
from array import array
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

from executor.recorder.cdr import encode_object
from executor.render.jpeg import to_jpeg
from executor.ros.feed import Coded, Shown
from executor.ros.messages import to_time

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["BatchTap", "TopicTap", "kind_of"]

PICTURES_HZ: Final = 10.0
SLACK_S: Final = 1e-6
_IMAGE: Final = "/image_raw"
_PICTURES: Final = (Shown, Image)


def kind_of(message: Any) -> str:
    """Returns the type of a message, as `sensor_msgs/msg/LaserScan`."""
    kind = type(message)
    return _name(kind.__module__, kind.__name__)


@functools.cache
def _name(module: str, name: str) -> str:
    return f"{module.partition('.')[0]}/msg/{name}"


class TopicTap:
    """Takes messages.

    Args:
        write: is called with the topic, the type, the simulated time in s, and the message as CDR.
    """

    def __init__(self, write: Callable[[str, str, float, bytes], None]) -> None:
        self._write = write
        self._pictures_s: dict[str, float] = {}
        """The time of the last picture of each topic."""

    def __call__(self, topic: str, message: Any, now_s: float) -> None:
        """Takes one message."""
        if isinstance(message, Coded):
            self._write(topic, message.kind, now_s, message.data)
        elif isinstance(message, Shown):
            self._picture(topic, message.message, now_s, message.jpeg)
        elif isinstance(message, Image):
            self._picture(topic, message, now_s, functools.partial(_coded, message))
        else:
            kind = kind_of(message)
            self._write(topic, kind, now_s, encode_object(kind, message))

    def jpeg(self, topic: str, jpeg: bytes, now_s: float, frame_id: str) -> None:
        """Takes a picture that is coded already; at most ten in a second of each camera.

        It is left out while the topic of the camera has as many.
        """
        if self._is_due(f"/{frame_id}{_IMAGE}", now_s) and self._is_due(topic, now_s):
            self._pictures_s[topic] = now_s
            self._write_jpeg(topic, jpeg, now_s, Header(stamp=to_time(now_s), frame_id=frame_id))

    def _is_due(self, topic: str, now_s: float) -> bool:
        """Returns whether the last picture is old enough, or of an earlier run, whose time is later."""
        last_s = self._pictures_s.get(topic)
        return last_s is None or now_s < last_s or now_s >= last_s + 1.0 / PICTURES_HZ - SLACK_S

    def _picture(self, topic: str, message: Any, now_s: float, code: Callable[[], bytes]) -> None:
        """Takes a colour image; depth has no place in a JPEG."""
        if message.encoding != "rgb8" or not self._is_due(topic, now_s):
            return
        self._pictures_s[topic] = now_s
        self._write_jpeg(topic, code(), now_s, message.header)

    def _write_jpeg(self, topic: str, jpeg: bytes, now_s: float, header: Header) -> None:
        packed = CompressedImage(header=header, format="rgb8; jpeg compressed bgr8")
        packed.data = array("B", jpeg)  # of all other types ROS looks at each byte
        self._write(f"{topic}/compressed", kind_of(packed), now_s, encode_object(kind_of(packed), packed))


def _coded(message: Any) -> bytes:
    pixels = np.frombuffer(message.data, np.uint8).reshape(message.height, message.width, 3)
    return to_jpeg(pixels)


class BatchTap(TopicTap):
    """Takes messages as they come, and encodes them together: at once it costs a third.

    Pictures are taken immediately, since the next one replaces them.
    """

    def __init__(self, write: Callable[[str, str, float, bytes], None]) -> None:
        super().__init__(write)
        self._held: list[tuple[str, Any, float]] = []

    def __call__(self, topic: str, message: Any, now_s: float) -> None:
        """Holds one message; nobody may change it."""
        if isinstance(message, _PICTURES):
            super().__call__(topic, message, now_s)
        else:
            self._held.append((topic, message, now_s))

    def flush(self) -> None:
        """Encodes and writes the messages that are held."""
        held, self._held = self._held, []
        for topic, message, now_s in held:
            super().__call__(topic, message, now_s)
