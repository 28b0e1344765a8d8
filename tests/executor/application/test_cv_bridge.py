"""Pictures between ROS messages and arrays."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from executor.application.cv_bridge import CvBridge, CvBridgeError


def image(
    encoding: str, data: bytes, width: int, height: int, step: int, *, big: bool = False
) -> SimpleNamespace:
    return SimpleNamespace(
        encoding=encoding, data=data, width=width, height=height, step=step, is_bigendian=int(big)
    )


def test_rows_may_be_padded_and_colours_are_exchanged() -> None:
    message = image("rgb8", bytes([1, 2, 3, 0, 4, 5, 6, 0]), 1, 2, 4)
    assert CvBridge().imgmsg_to_cv2(message).tolist() == [[[1, 2, 3]], [[4, 5, 6]]]
    assert CvBridge().imgmsg_to_cv2(message, "bgr8").tolist() == [[[3, 2, 1]], [[6, 5, 4]]]


def test_numbers_of_the_other_byte_order_are_read() -> None:
    found = CvBridge().imgmsg_to_cv2(image("mono16", b"\x01\x02", 1, 1, 2, big=True))
    assert found.tolist() == [[0x0102]]
    assert found.dtype == np.uint16


@pytest.mark.parametrize(("encoding", "wanted"), [("nonsense", "passthrough"), ("mono16", "rgb8")])
def test_what_cannot_be_converted_is_refused(encoding: str, wanted: str) -> None:
    with pytest.raises(CvBridgeError):
        CvBridge().imgmsg_to_cv2(image(encoding, b"\0\0", 1, 1, 2), wanted)
