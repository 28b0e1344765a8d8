"""Messages of topics for a recording."""

from __future__ import annotations

import numpy as np
import simplejpeg
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Bool

from executor.ros.feed import Coded, Shown
from executor.ros.tap import BatchTap, TopicTap, kind_of


def taken(*messages):
    said = []
    tap = TopicTap(lambda *message: said.append(message))
    for message, now_s in messages:
        tap("/topic", message, now_s)
    return said


def test_a_message_is_taken_as_it_is():
    ((topic, kind, now_s, data),) = taken((Bool(data=True), 2.0))
    assert (topic, kind, now_s) == ("/topic", "std_msgs/msg/Bool", 2.0)
    assert deserialize_message(data, Bool) == Bool(data=True)


def test_pictures_are_jpeg_at_most_ten_in_a_second():
    pixels = np.full((16, 32, 3), 200, np.uint8)
    picture = Image(height=16, width=32, encoding="rgb8", data=pixels.tobytes())
    said = taken(*((picture, number / 30) for number in range(31)))
    assert len(said) == 11
    topic, kind, _, data = said[0]
    assert (topic, kind) == ("/topic/compressed", "sensor_msgs/msg/CompressedImage")
    read = simplejpeg.decode_jpeg(bytes(deserialize_message(data, CompressedImage).data))
    assert read.shape == pixels.shape
    assert abs(int(read.mean()) - 200) < 3


def test_a_run_whose_time_begins_again_has_pictures_from_its_begin():
    picture = Image(height=16, width=32, encoding="rgb8", data=bytes(16 * 32 * 3))
    said = []
    tap = TopicTap(lambda *message: said.append(message))
    for now_s in (50.0, 0.0, 0.05, 0.1):
        tap("/topic", picture, now_s)
        tap.jpeg("/world/camera/front", b"jpeg", now_s, "front")
    assert [(topic, now_s) for topic, _, now_s, _ in said] == [
        (topic, now_s)
        for now_s in (50.0, 0.0, 0.1)
        for topic in ("/topic/compressed", "/world/camera/front/compressed")
    ]


def test_depth_is_left_out():
    assert taken((Image(encoding="32FC1"), 0.0)) == []
    assert kind_of(Image()) == "sensor_msgs/msg/Image"


def test_a_picture_that_is_coded_for_others_is_not_coded_again_and_recorded_once():
    said = []
    tap = TopicTap(lambda *message: said.append(message))
    picture = Image(height=16, width=32, encoding="rgb8", data=bytes(16 * 32 * 3))
    tap("/camera/image_raw", Shown(picture, lambda: b"jpeg"), 0.0)
    tap.jpeg("/world/camera/camera", b"jpeg", 0.0, "camera")
    tap.jpeg("/world/camera/other", b"jpeg", 0.0, "other")
    # Drawn for a client between two pictures of the topic, which has ten in a second.
    tap.jpeg("/world/camera/camera", b"smaller", 0.05, "camera")
    tap("/camera/image_raw", Shown(picture, lambda: b"jpeg"), 0.1)
    tap.jpeg("/world/camera/camera", b"next", 0.15, "camera")
    tap.jpeg("/world/camera/camera", b"alone", 0.3, "camera")
    assert [(topic, now_s) for topic, _, now_s, _ in said] == [
        ("/camera/image_raw/compressed", 0.0),
        ("/world/camera/other/compressed", 0.0),
        ("/camera/image_raw/compressed", 0.1),
        ("/world/camera/camera/compressed", 0.3),
    ]
    assert bytes(deserialize_message(said[0][3], CompressedImage).data) == b"jpeg"


def test_a_message_that_is_coded_is_taken_as_it_is():
    assert taken((Coded("tf2_msgs/msg/TFMessage", b"cdr"), 1.0)) == [
        ("/topic", "tf2_msgs/msg/TFMessage", 1.0, b"cdr")
    ]


def test_messages_of_a_batch_are_written_together_in_their_order_and_pictures_at_once():
    said = []
    tap = BatchTap(lambda *message: said.append(message))
    tap("/a", Bool(data=True), 1.0)
    tap("/b", Coded("std_msgs/msg/Bool", b"cdr"), 2.0)
    picture = Image(height=16, width=32, encoding="rgb8", data=bytes(16 * 32 * 3))
    tap("/camera/image_raw", Shown(picture, lambda: b"jpeg"), 3.0)
    assert [topic for topic, *_ in said] == ["/camera/image_raw/compressed"]
    tap.flush()
    tap.flush()
    assert [(topic, now_s) for topic, _, now_s, _ in said[1:]] == [("/a", 1.0), ("/b", 2.0)]
    assert deserialize_message(said[1][3], Bool) == Bool(data=True)
