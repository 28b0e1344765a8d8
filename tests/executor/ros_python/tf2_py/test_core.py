"""Look-ups of transforms, compared with matrices and with tf2's documentation."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest
from builtin_interfaces.msg import Time as Stamp
from geometry_msgs.msg import (
    PointStamped,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
)
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from rclpy.duration import Duration
from rclpy.time import Time

metres = st.floats(-50, 50)
unit = st.floats(-1, 1)
turns = st.tuples(unit, unit, unit, unit).filter(lambda q: sum(x * x for x in q) > 0.01)
poses = st.tuples(st.tuples(metres, metres, metres), turns)


def stamped(parent: str, child: str, pose: Any, at_s: float = 1.0) -> TransformStamped:
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp = Time(nanoseconds=round(at_s * 1e9)).to_msg()
    move, turn = message.transform.translation, message.transform.rotation
    move.x, move.y, move.z = pose[0]
    length = math.sqrt(sum(part * part for part in pose[1]))
    turn.x, turn.y, turn.z, turn.w = (part / length for part in pose[1])
    return message


def about_z(angle: float) -> tuple[float, float, float, float]:
    return 0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2)


def plain(x: float, angle: float = 0.0) -> Any:
    return (float(x), 0.0, 0.0), about_z(angle)


def matrix(message: TransformStamped) -> NDArray[np.float64]:
    """Returns the transform as a matrix, by the textbook's formula and not by that of the code."""
    move, turn = message.transform.translation, message.transform.rotation
    x, y, z, w = turn.x, turn.y, turn.z, turn.w
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), move.x],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), move.y],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), move.z],
            [0, 0, 0, 1],
        ]
    )


def buffer_of(transforms: Iterable[TransformStamped], **options: Any) -> Any:
    from tf2_ros import Buffer

    buffer = Buffer(**options)
    for transform in transforms:
        buffer.set_transform(transform, "test")
    return buffer


def at(seconds: float) -> Time:
    return Time(nanoseconds=round(seconds * 1e9))


@given(poses, poses, poses)
def test_a_way_up_and_down_is_the_product_of_its_matrices(one: Any, two: Any, three: Any) -> None:
    sent = [stamped("map", "odom", one), stamped("odom", "base", two), stamped("map", "goal", three)]
    found = buffer_of(sent).lookup_transform("goal", "base", Time())
    up, across, down = map(matrix, sent)
    assert matrix(found) == pytest.approx(np.linalg.inv(down) @ up @ across, abs=1e-9)
    assert (found.header.frame_id, found.child_frame_id) == ("goal", "base")


@given(poses, poses)
def test_there_and_back_is_nowhere(one: Any, two: Any) -> None:
    buffer = buffer_of([stamped("map", "odom", one), stamped("odom", "base", two)])
    there, back = (buffer.lookup_transform(*pair, Time()) for pair in (("map", "base"), ("base", "map")))
    assert matrix(there) @ matrix(back) == pytest.approx(np.eye(4), abs=1e-9)


@given(poses, poses, st.floats(0, 1))
def test_between_two_samples_it_moves_straight_and_turns_evenly(one: Any, two: Any, share: float) -> None:
    first, last = stamped("odom", "base", one, 1.0), stamped("odom", "base", two, 2.0)
    found = buffer_of([first, last]).lookup_transform("odom", "base", at(1.0 + share))
    a, b, c = map(matrix, (first, last, found))
    share = round(share * 1e9) / 1e9
    assert c[:3, 3] == pytest.approx((1 - share) * a[:3, 3] + share * b[:3, 3], abs=1e-6)
    whole, part = (_angle(a[:3, :3].T @ each[:3, :3]) for each in (b, c))
    assert part == pytest.approx(share * whole, abs=1e-5)


def _angle(turn: NDArray[np.float64]) -> float:
    vector = turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]
    return math.atan2(math.hypot(*vector), float(np.trace(turn)) - 1)


def test_time_0_is_the_latest_that_both_know() -> None:
    buffer = buffer_of(stamped("map", "odom", plain(t), t) for t in (1.0, 2.0, 3.0))
    buffer.set_transform(stamped("odom", "base", plain(0), 2.5), "test")
    buffer.set_transform(stamped("odom", "base", plain(0), 0.5), "test")
    found = buffer.lookup_transform("map", "base", Time())
    assert Time.from_msg(found.header.stamp).nanoseconds == 2_500_000_000
    assert found.transform.translation.x == pytest.approx(2.5)


def test_a_message_of_time_is_a_time_too() -> None:
    buffer = buffer_of(stamped("map", "base", plain(t), t) for t in (1.0, 2.0))
    found = buffer.lookup_transform("map", "base", Stamp(sec=1, nanosec=250_000_000))
    assert found.transform.translation.x == pytest.approx(1.25)


@pytest.mark.parametrize(("when", "into"), [(0.5, "past"), (2.5, "future")])
def test_outside_of_what_was_heard_is_extrapolation(when: float, into: str) -> None:
    from tf2_ros import ExtrapolationException, TransformException

    buffer = buffer_of(stamped("map", "base", plain(t), t) for t in (1.0, 2.0))
    with pytest.raises(ExtrapolationException, match=f"extrapolation into the {into}") as raised:
        buffer.lookup_transform("map", "base", at(when))
    assert isinstance(raised.value, TransformException)
    assert buffer.can_transform("map", "base", at(when)) is False
    assert buffer.can_transform("map", "base", at(when), return_debug_tuple=True)[1]


def test_one_sample_is_known_at_its_time_alone() -> None:
    from tf2_ros import ExtrapolationException

    buffer = buffer_of([stamped("map", "base", plain(1), 1.0)])
    assert buffer.can_transform("map", "base", at(1.0))
    with pytest.raises(ExtrapolationException, match="only time 1"):
        buffer.lookup_transform("map", "base", at(1.1))


def test_what_is_static_is_known_at_all_times() -> None:
    buffer = buffer_of([])
    buffer.set_transform_static(stamped("base", "laser", plain(0.1)), "test")
    for when in (Time(), at(0.001), at(1e6)):
        assert buffer.lookup_transform("base", "laser", when).transform.translation.x == pytest.approx(0.1)


def test_ten_seconds_are_kept_or_as_many_as_asked_for() -> None:
    for options, kept in (({}, 10.0), ({"cache_time": Duration(seconds=2)}, 2.0)):
        buffer = buffer_of((stamped("map", "base", plain(t), t) for t in range(1, 40)), **options)
        assert buffer.can_transform("map", "base", at(39 - kept))
        assert not buffer.can_transform("map", "base", at(39 - kept - 0.1))


def test_from_one_time_to_another_by_a_fixed_frame() -> None:
    buffer = buffer_of(stamped("odom", "base", plain(t), t) for t in (1.0, 2.0, 3.0))
    found = buffer.lookup_transform_full("base", at(3.0), "base", at(1.0), "odom")
    assert found.transform.translation.x == pytest.approx(-2.0)
    assert Time.from_msg(found.header.stamp).nanoseconds == 3_000_000_000


def test_an_unknown_frame_and_a_split_tree_are_distinguished() -> None:
    from tf2_ros import ConnectivityException, InvalidArgumentException, LookupException

    buffer = buffer_of([stamped("map", "base", plain(1)), stamped("other", "thing", plain(1))])
    with pytest.raises(LookupException, match=r'"nowhere" passed to lookupTransform .* does not exist'):
        buffer.lookup_transform("map", "nowhere", Time())
    with pytest.raises(ConnectivityException, match="two or more unconnected trees"):
        buffer.lookup_transform("map", "thing", Time())
    for bad in ("", "/map"):
        with pytest.raises(InvalidArgumentException):
            buffer.lookup_transform(bad, "base", Time())


def test_a_loop_ends_with_an_error() -> None:
    from tf2_ros import LookupException

    sent = [stamped("a", "b", plain(1)), stamped("b", "a", plain(1)), stamped("x", "y", plain(0))]
    buffer = buffer_of(sent)
    with pytest.raises(LookupException, match="loop"):
        buffer.lookup_transform("x", "a", Time())


@pytest.mark.parametrize("spoil", ["nan", "long", "self", "nameless"])
def test_invalid_transforms_are_ignored(spoil: str) -> None:
    message = stamped("map", "base", plain(1))
    if spoil == "nan":
        message.transform.translation.x = math.nan
    elif spoil == "long":
        message.transform.rotation.w = 2.0
    elif spoil == "self":
        message.child_frame_id = "map"
    else:
        message.child_frame_id = ""
    assert buffer_of([message])._getFrameStrings() == []


def test_a_jump_back_in_time_clears_dynamic_transforms() -> None:
    buffer = buffer_of([stamped("map", "base", plain(1))])
    buffer.set_transform_static(stamped("base", "laser", plain(0.1)), "test")
    buffer.time_jump_callback(None)
    assert not buffer.can_transform("map", "base", Time())
    assert buffer.can_transform("base", "laser", Time())


def test_points_poses_and_vectors_come_into_another_frame() -> None:
    import tf2_geometry_msgs  # noqa: F401 - registers

    buffer = buffer_of([stamped("map", "base", ((1.0, 2.0, 0.0), about_z(math.pi / 2)))])
    point = PointStamped()
    point.point.x = 1.0
    pose = PoseStamped()
    pose.pose.position.x = pose.pose.orientation.w = 1.0
    vector = Vector3Stamped()
    vector.vector.x = 1.0
    for thing in (point, pose, vector):
        thing.header.frame_id = "base"
    found = buffer.transform(point, "map")
    assert found.header.frame_id == "map"
    assert (found.point.x, found.point.y) == pytest.approx((1.0, 3.0))
    turned = buffer.transform(pose, "map").pose
    assert (turned.position.x, turned.position.y) == pytest.approx((1.0, 3.0))
    assert turned.orientation.z == pytest.approx(math.sin(math.pi / 4))
    turned = buffer.transform(vector, "map").vector
    assert (turned.x, turned.y) == pytest.approx((0.0, 1.0)), "a vector is not moved"
    assert point.header.frame_id == "base", "what was given is not changed"


@given(turns)
def test_a_covariance_keeps_its_size_when_it_is_turned(turn: Any) -> None:
    from tf2_geometry_msgs import do_transform_pose_with_covariance_stamped

    message = PoseWithCovarianceStamped()
    message.pose.pose.orientation.w = 1.0
    spread = np.diag([4.0, 1.0, 0.5, 0.1, 0.2, 0.3])
    spread[0, 1] = spread[1, 0] = 0.7
    message.pose.covariance = spread.reshape(36)
    transform = stamped("map", "base", ((0.0, 0.0, 0.0), turn))
    found = do_transform_pose_with_covariance_stamped(message, transform).pose.covariance.reshape(6, 6)
    rotation = matrix(transform)[:3, :3]
    assert found[:3, :3] == pytest.approx(rotation @ spread[:3, :3] @ rotation.T)
    assert found[3:, 3:] == pytest.approx(rotation @ spread[3:, 3:] @ rotation.T)


def test_an_unregistered_type_is_reported() -> None:
    from tf2_ros import TypeException

    buffer = buffer_of([stamped("map", "base", plain(1))])
    thing = stamped("base", "x", plain(0))
    with pytest.raises(TypeException, match="not loaded or supported"):
        buffer.transform(thing, "map")


def test_frames_are_known_once_they_are_heard() -> None:
    from tf2_py.core import BufferCore

    core = BufferCore()
    assert not core.can_transform_core("map", "base", Time())[0]
    core.set_transform(stamped("map", "base", plain(1.0)), "test")
    assert core.can_transform_core("map", "base", Time())[0]
