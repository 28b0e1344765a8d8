"""Replaces the part of ROS's `cv_bridge` that actions use, if the real one is not installed.

`CvBridge.imgmsg_to_cv2` and `CvBridge.cv2_to_imgmsg` convert between `sensor_msgs/Image` and arrays.
"""

from __future__ import annotations

import array
import sys
from typing import Any, Final

import numpy as np

__all__ = ["CvBridge", "CvBridgeError"]

# Encoding: element type and channels. The bare names of OpenCV types (8UC3) are parsed.
_NAMED: Final[dict[str, tuple[str, int]]] = {
    "rgb8": ("u1", 3),
    "bgr8": ("u1", 3),
    "rgba8": ("u1", 4),
    "bgra8": ("u1", 4),
    "mono8": ("u1", 1),
    "mono16": ("u2", 1),
}
_TYPES: Final = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
_COLOURS: Final = {"rgb8": "RGB", "bgr8": "BGR", "rgba8": "RGBA", "bgra8": "BGRA", "mono8": "GRAY"}


class CvBridgeError(TypeError):
    """The picture cannot be converted."""


def _layout(encoding: str) -> tuple[np.dtype[Any], int]:
    if encoding in _NAMED:
        code, channels = _NAMED[encoding]
        return np.dtype(code), channels
    depth, _, channel_text = encoding.partition("C")
    if depth in _TYPES and (channel_text.isdigit() or not channel_text):
        return np.dtype(_TYPES[depth]), int(channel_text or 1)
    raise CvBridgeError(f"unknown encoding {encoding!r}")


def _convert(picture: Any, source: str, target: str) -> Any:
    if target in {"passthrough", source}:
        return picture
    if source not in _COLOURS or target not in _COLOURS:
        raise CvBridgeError(f"cannot convert {source!r} to {target!r}")
    import cv2  # noqa: PLC0415 - only those who convert colours need it

    return cv2.cvtColor(picture, getattr(cv2, f"COLOR_{_COLOURS[source]}2{_COLOURS[target]}"))


class CvBridge:
    """Converts pictures between ROS messages and arrays."""

    def imgmsg_to_cv2(self, img_msg: Any, desired_encoding: str = "passthrough") -> Any:
        """Returns the picture of an `Image` message as an array, rows first.

        Raises:
            CvBridgeError: the encoding is unknown, or cannot be converted to the desired one.
        """
        kind, channels = _layout(img_msg.encoding)
        kind = kind.newbyteorder(">" if img_msg.is_bigendian else "<")
        rows = np.frombuffer(img_msg.data, np.uint8).reshape(img_msg.height, img_msg.step)
        width_bytes = img_msg.width * channels * kind.itemsize
        picture = np.ascontiguousarray(rows[:, :width_bytes]).view(kind)
        if channels > 1:
            picture = picture.reshape(img_msg.height, img_msg.width, channels)
        return _convert(
            picture.astype(kind.newbyteorder("="), copy=False), img_msg.encoding, desired_encoding
        )

    def cv2_to_imgmsg(self, cvim: Any, encoding: str = "passthrough", header: Any = None) -> Any:
        """Returns an `Image` message with the picture of an array.

        Raises:
            CvBridgeError: the array does not fit the encoding.
        """
        from sensor_msgs.msg import Image  # noqa: PLC0415 - ROS is loaded by those who have it

        picture = np.ascontiguousarray(cvim)
        channels = 1 if picture.ndim == 2 else picture.shape[2]
        names = {code: name for name, code in _TYPES.items()}
        own = f"{names.get(picture.dtype.str[1:], '?')}C{channels}"
        encoding = own if encoding == "passthrough" else encoding
        kind, wanted = _layout(encoding)
        if kind.itemsize != picture.dtype.itemsize or wanted != channels:
            raise CvBridgeError(f"an array of {own} is not {encoding!r}")
        message = Image()
        if header is not None:
            message.header = header
        message.height, message.width = picture.shape[:2]
        message.encoding = encoding
        message.is_bigendian = int(sys.byteorder == "big")
        message.step = picture.strides[0]
        message.data = array.array("B", picture.tobytes())
        return message
