"""Where the bodies of a recorded world are."""

from __future__ import annotations

import math
import struct

import msgspec
import numpy as np
import pytest

from executor.messages import Poses, Scene, SceneObject, Shape
from executor.recorder.summary.places import MOST_TRAIL, Places
from executor.stream.pose_codec import pack

HERE = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
encode = msgspec.msgpack.Encoder().encode


def at(x, y, yaw=0.0):
    return [x, y, 0.0, 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)]


def scene(*objects):
    return encode(Scene("room", 0.0, list(objects), {}, [], [0.0], []))


def body(number, kind, pose, *shapes):
    return SceneObject(number, f"body {number}", "", kind, list(shapes), pose)


def poses(**places):
    ids = struct.pack(f"<{len(places)}H", *(int(name[1:]) for name in places))
    return encode(Poses(0.0, ids, pack(np.array(list(places.values()), np.float32))))


BOX = Shape("box", [2.0, 1.0, 1.0], HERE, [1.0, 1.0, 1.0, 1.0])
BALL = Shape("sphere", [0.5], HERE, [1.0, 1.0, 1.0, 1.0])


def test_bodies_are_where_they_were_last_and_the_robot_leaves_a_trail():
    places = Places()
    places.scene(
        scene(
            body(1, "static", at(3, 0, math.pi / 2), BOX),
            body(2, "dynamic", at(0, 0), BALL),
            body(3, "robot", at(0, 0), BALL),
        )
    )
    places.poses(poses(n2=at(5, 6), n3=at(1, 1)))
    places.poses(poses(n3=at(2, 1)))
    assert places.trail() == [[1.0, 1.0], [2.0, 1.0]]
    assert places.boxes() == [[3.0, 0.0, 1.0, 0.5, 1.571, 0.0], [5.0, 6.0, 0.5, 0.5, 0.0, 1.0]]


def test_a_shape_is_placed_in_its_body():
    places = Places()
    shape = Shape("cylinder", [0.2, 1.0], at(1, 0), [1.0, 1.0, 1.0, 1.0])
    places.scene(scene(body(1, "static", at(0, 0, math.pi / 2), shape)))
    (row,) = places.boxes()
    assert row == pytest.approx([0, 1, 0.2, 0.2, math.pi / 2, 1], abs=1e-3)


def test_planes_meshes_and_what_is_too_far_are_left_out():
    places = Places()
    plane = Shape("plane", [9.0, 9.0], HERE, [1.0, 1.0, 1.0, 1.0])
    places.scene(
        scene(body(1, "static", at(0, 0), plane), body(2, "static", at(math.nan, 0), BOX)),
    )
    assert places.boxes() == []


def test_a_long_trail_is_thinned_and_keeps_its_begin():
    places = Places()
    places.scene(scene(body(3, "robot", at(0, 0), BALL)))
    for x in range(2000):
        places.poses(poses(n3=at(x / 10, 0)))
    trail = places.trail()
    assert MOST_TRAIL / 4 < len(trail) < MOST_TRAIL
    assert trail[0] == [0.0, 0.0]
    assert trail[-1][0] > 190


@pytest.mark.parametrize("data", [b"", b"\xc1", encode({"type": "poses"}), encode(Poses(0.0, b"\1", b""))])
def test_what_is_no_frame_is_an_error(data):
    with pytest.raises(ValueError, match=r".+"):
        Places().poses(data)
    with pytest.raises(ValueError, match=r".+"):
        Places().scene(data)
