"""Converts `sensor_msgs/PointCloud2` from and to arrays."""

from __future__ import annotations

import array
import sys
from collections import namedtuple
from typing import TYPE_CHECKING, Any

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py.numpy_compat import structured_to_unstructured, unstructured_to_structured

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

DUMMY_FIELD_PREFIX = "unnamed_field"
_TYPES: dict[int, np.dtype[Any]] = {
    PointField.INT8: np.dtype(np.int8),
    PointField.UINT8: np.dtype(np.uint8),
    PointField.INT16: np.dtype(np.int16),
    PointField.UINT16: np.dtype(np.uint16),
    PointField.INT32: np.dtype(np.int32),
    PointField.UINT32: np.dtype(np.uint32),
    PointField.FLOAT32: np.dtype(np.float32),
    PointField.FLOAT64: np.dtype(np.float64),
}


def read_points(
    cloud: Any,
    field_names: list[str] | None = None,
    skip_nans: bool = False,  # noqa: FBT001, FBT002 - as in ROS
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,  # noqa: FBT001, FBT002 - as in ROS
) -> Any:
    """Returns the points of a cloud as a structured array.

    Args:
        cloud: the message.
        field_names: the fields to read; None reads all fields.
        skip_nans: whether to leave out points with a value that is not a number.
        uvs: the points to read: indices, or pairs of column and row of an organised cloud; None reads all
            points.
        reshape_organized_cloud: whether an organised cloud is returned with rows and columns.
    """
    kind = dtype_from_fields(cloud.fields, cloud.point_step)
    rows = np.frombuffer(cloud.data, np.uint8).reshape(cloud.height, cloud.row_step)
    width = cloud.width * cloud.point_step
    points: Any = np.ascontiguousarray(rows[:, :width]).reshape(-1).view(kind)
    if cloud.is_bigendian != (sys.byteorder != "little"):
        points = points.byteswap()
    if field_names is not None:
        names = points.dtype.names
        unknown = [name for name in field_names if name not in names]
        if unknown:
            raise ValueError(f"the cloud has no field {unknown[0]!r}; it has {', '.join(names)}")
        points = points[field_names]
    if uvs is not None:
        points = points[_indices(uvs, cloud.width)]
    if skip_nans and not cloud.is_dense:
        is_number = np.ones(len(points), bool)
        for name in points.dtype.names:
            bad = np.isnan(points[name])
            is_number &= ~(bad.any(axis=-1) if bad.ndim > 1 else bad)
        points = points[is_number]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.height, cloud.width)
    return points


def read_points_numpy(
    cloud: Any,
    field_names: list[str] | None = None,
    skip_nans: bool = False,  # noqa: FBT001, FBT002 - as in ROS
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,  # noqa: FBT001, FBT002 - as in ROS
) -> Any:
    """Returns the points of a cloud as a plain array with a row for each point.

    All fields that are read must have one type.
    """
    wanted = [field for field in cloud.fields if field_names is None or field.name in field_names]
    if len({field.datatype for field in wanted}) > 1:
        raise ValueError("the fields are of several types; read_points can read them")
    points = read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    return structured_to_unstructured(points)


def read_points_list(
    cloud: Any,
    field_names: list[str] | None = None,
    skip_nans: bool = False,  # noqa: FBT001, FBT002 - as in ROS
    uvs: Iterable[Any] | None = None,
) -> list[Any]:
    """Returns the points of a cloud as a list of named tuples."""
    points = read_points(cloud, field_names, skip_nans, uvs)
    names: list[str] = list(points.dtype.names)
    point: Any = namedtuple("Point", names)  # type: ignore[misc]
    return [point._make(each) for each in points.tolist()]


def dtype_from_fields(fields: Iterable[Any], point_step: int | None = None) -> np.dtype[Any]:
    """Returns the numpy type of one point.

    A field of several values has a column for each, `name_0`, `name_1` …; a field without a name is called by
    its number.
    """
    names, formats, offsets = [], [], []
    for number, field in enumerate(fields):
        if field.count < 1:
            raise ValueError(f"the field {field.name!r} has no values")
        kind = _TYPES[field.datatype]
        name = field.name or f"{DUMMY_FIELD_PREFIX}_{number}"
        for part in range(field.count):
            names.append(f"{name}_{part}" if field.count > 1 else name)
            formats.append(kind)
            offsets.append(field.offset + part * kind.itemsize)
    if len(set(names)) < len(names):
        raise ValueError("two fields have one name")
    layout: Any = {"names": names, "formats": formats, "offsets": offsets}
    if point_step is not None:
        layout["itemsize"] = point_step
    return np.dtype(layout)


def create_cloud(header: Any, fields: Sequence[Any], points: Any, point_step: int | None = None) -> Any:
    """Returns a cloud.

    Args:
        header: the header of the message.
        fields: the fields of a point.
        points: a structured array, an array with a row for each point, or rows of values; for an organised
            cloud, the points have two dimensions.
        point_step: the bytes of a point, if they are more than those of its fields.
    """
    kind = dtype_from_fields(fields, point_step)
    table = points if isinstance(points, np.ndarray) else np.array([tuple(each) for each in points], kind)
    if table.dtype.names is None:
        table = unstructured_to_structured(table, kind)
    elif table.dtype != kind:
        raise ValueError(f"the points are {table.dtype}, and the fields make {kind}")
    if table.ndim > 2:
        raise ValueError("points lie in a list, or in rows and columns")
    height, width = table.shape if table.ndim == 2 else (1, len(table))
    data = array.array("B")
    data.frombytes(np.ascontiguousarray(table).tobytes())
    return PointCloud2(
        header=header,
        height=height,
        width=width,
        is_dense=False,
        is_bigendian=sys.byteorder != "little",
        fields=list(fields),
        point_step=kind.itemsize,
        row_step=kind.itemsize * width,
        data=data,
    )


def create_cloud_xyz32(header: Any, points: Any) -> Any:
    """Returns a cloud of x, y and z in m, as 32-bit numbers."""
    names = ("x", "y", "z")
    fields = [
        PointField(name=name, offset=4 * i, datatype=PointField.FLOAT32, count=1)
        for i, name in enumerate(names)
    ]
    return create_cloud(header, fields, points)


def _indices(uvs: Iterable[Any], width: int) -> Any:
    wanted = np.asarray(list(uvs))
    return wanted[:, 1] * width + wanted[:, 0] if wanted.ndim == 2 else wanted
