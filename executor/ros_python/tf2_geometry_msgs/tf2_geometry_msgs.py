"""Transforms messages of `geometry_msgs` into another frame; arguments are not modified."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import numpy as np
from geometry_msgs.msg import (
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    Vector3Stamped,
    WrenchStamped,
)
from tf2_py.motion import Motion, compose, rotate
from tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration


def do_transform_point(point: Any, transform: Any) -> Any:
    """Returns a `PointStamped` in the transform's frame."""
    result = PointStamped(header=deepcopy(transform.header))
    _put(result.point, _moved(transform, point.point))
    return result


def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """Returns a `Vector3Stamped` in the transform's frame; a vector is rotated but not translated."""
    result = Vector3Stamped(header=deepcopy(transform.header))
    _put(result.vector, rotate(_motion(transform).rotation, _xyz(vector3.vector)))
    return result


def do_transform_pose(pose: Any, transform: Any) -> Any:
    """Returns a `Pose` in the transform's frame."""
    turn = pose.orientation
    inner = Motion(_xyz(pose.position), (turn.x, turn.y, turn.z, turn.w))
    motion = compose(_motion(transform), inner)
    result = Pose()
    _put(result.position, motion.translation)
    turned = result.orientation
    turned.x, turned.y, turned.z, turned.w = motion.rotation
    return result


def do_transform_pose_stamped(pose: Any, transform: Any) -> Any:
    """Returns a `PoseStamped` in the transform's frame."""
    return PoseStamped(header=deepcopy(transform.header), pose=do_transform_pose(pose.pose, transform))


def do_transform_pose_with_covariance_stamped(pose: Any, transform: Any) -> Any:
    """Returns a `PoseWithCovarianceStamped` in the transform's frame."""
    result = PoseWithCovarianceStamped(header=deepcopy(transform.header))
    result.pose.pose = do_transform_pose(pose.pose.pose, transform)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def do_transform_polygon_stamped(polygon: Any, transform: Any) -> Any:
    """Returns a `PolygonStamped` in the transform's frame."""
    result = PolygonStamped(header=deepcopy(transform.header))
    for point in polygon.polygon.points:
        result.polygon.points.append(Point32())
        _put(result.polygon.points[-1], _moved(transform, point))
    return result


def do_transform_wrench(wrench: Any, transform: Any) -> Any:
    """Returns a `WrenchStamped` in the transform's frame; force and torque are rotated but not translated."""
    result = WrenchStamped(header=deepcopy(transform.header))
    turn = _motion(transform).rotation
    _put(result.wrench.force, rotate(turn, _xyz(wrench.wrench.force)))
    _put(result.wrench.torque, rotate(turn, _xyz(wrench.wrench.torque)))
    return result


def transform_covariance(cov_in: Any, transform: Any) -> Any:
    """Returns a covariance of x, y, z and the rotations about them, rotated into another frame: R C Rᵀ."""
    turn = _motion(transform).rotation
    columns = [rotate(turn, axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    both = np.kron(np.eye(2), np.array(columns).T)
    return (both @ np.array(cov_in, dtype=float).reshape(6, 6) @ both.T).reshape(36)


def to_msg_msg(msg: Any) -> Any:
    """Returns the message unchanged."""
    return msg


from_msg_msg = to_msg_msg


def _motion(transform: Any) -> Motion:
    turn = transform.transform.rotation
    return Motion(_xyz(transform.transform.translation), (turn.x, turn.y, turn.z, turn.w))


def _moved(transform: Any, point: Any) -> tuple[float, float, float]:
    return compose(_motion(transform), Motion(_xyz(point))).translation


def _xyz(vector: Any) -> tuple[float, float, float]:
    return vector.x, vector.y, vector.z


def _put(vector: Any, values: tuple[float, float, float]) -> None:
    vector.x, vector.y, vector.z = values


for _kind, _function in (
    (PointStamped, do_transform_point),
    (Vector3Stamped, do_transform_vector3),
    (PoseStamped, do_transform_pose_stamped),
    (PoseWithCovarianceStamped, do_transform_pose_with_covariance_stamped),
    (PolygonStamped, do_transform_polygon_stamped),
    (WrenchStamped, do_transform_wrench),
):
    TransformRegistration().add(_kind, _function)
    ConvertRegistration().add_to_msg(_kind, to_msg_msg)
    ConvertRegistration().add_from_msg(_kind, from_msg_msg)
