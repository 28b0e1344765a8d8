"""Point clouds to arrays and back."""

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

numbers = st.floats(width=32, allow_nan=False)
HEADER = Header(frame_id="camera")


def field(name: str, offset: int, datatype: int = PointField.FLOAT32, count: int = 1) -> PointField:
    return PointField(name=name, offset=offset, datatype=datatype, count=count)


@given(st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=20))
def test_points_come_back_as_they_were(points: list[tuple[float, float, float]]) -> None:
    from sensor_msgs_py import point_cloud2

    cloud = point_cloud2.create_cloud_xyz32(HEADER, points)
    assert (cloud.height, cloud.width, cloud.point_step) == (1, len(points), 12)
    assert bytes(cloud.data) == b"".join(struct.pack("<3f", *each) for each in points), "by the wire's rule"
    assert point_cloud2.read_points_list(cloud) == points
    assert point_cloud2.read_points_numpy(cloud).tolist() == [list(each) for each in points]


def test_types_gaps_and_several_values_of_a_field() -> None:
    from sensor_msgs_py.point_cloud2 import create_cloud, dtype_from_fields, read_points

    fields = [field("x", 0), field("rgb", 8, PointField.UINT8, 3), field("", 12, PointField.FLOAT64)]
    kind = dtype_from_fields(fields, point_step=24)
    assert kind.names == ("x", "rgb_0", "rgb_1", "rgb_2", "unnamed_field_2")
    assert kind.itemsize == 24
    points = np.array([(1.5, 1, 2, 3, 9.25), (2.5, 4, 5, 6, 8.25)], kind)
    cloud = create_cloud(HEADER, fields, points, point_step=24)
    assert (cloud.row_step, len(cloud.data)) == (48, 48)
    assert read_points(cloud).tolist() == points.tolist()
    assert read_points(cloud, ["rgb_1"]).tolist() == [(2,), (5,)]


def test_some_points_of_an_organised_cloud_and_no_nans() -> None:
    from sensor_msgs_py.point_cloud2 import create_cloud, read_points, read_points_numpy

    fields = [field("x", 0), field("y", 4)]
    grid = np.arange(12, dtype=np.float32).reshape(2, 3, 2)
    grid[1, 2] = math.nan
    cloud = create_cloud(HEADER, fields, grid)
    assert (cloud.height, cloud.width) == (2, 3)
    assert read_points(cloud, reshape_organized_cloud=True).shape == (2, 3)
    assert len(read_points(cloud, skip_nans=True)) == 5
    assert read_points_numpy(cloud, uvs=[(1, 0), (0, 1)]).tolist() == [[2.0, 3.0], [6.0, 7.0]]
    assert read_points_numpy(cloud, uvs=[0]).tolist() == [[0.0, 1.0]]


def test_rows_with_padding_and_the_other_order_of_bytes() -> None:
    from sensor_msgs_py.point_cloud2 import read_points_list

    data = struct.pack(">2f", 1.0, 2.0) + b"\0\0\0\0" + struct.pack(">2f", 3.0, 4.0) + b"\0\0\0\0"
    cloud = PointCloud2(
        height=2, width=2, fields=[field("x", 0)], point_step=4, row_step=12, is_bigendian=True, data=data
    )
    assert read_points_list(cloud) == [(1.0,), (2.0,), (3.0,), (4.0,)]


def test_values_that_do_not_fit_are_reported() -> None:
    from sensor_msgs_py.point_cloud2 import create_cloud, dtype_from_fields, read_points, read_points_numpy

    cloud = create_cloud(HEADER, [field("x", 0), field("n", 4, PointField.UINT32)], [(1.0, 2)])
    with pytest.raises(ValueError, match="several types"):
        read_points_numpy(cloud)
    with pytest.raises(ValueError, match="no field 'z'; it has x, n"):
        read_points(cloud, ["z"])
    with pytest.raises(ValueError, match="one name"):
        dtype_from_fields([field("x", 0), field("x", 4)])
