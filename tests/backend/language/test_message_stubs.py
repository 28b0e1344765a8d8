"""Stubs of the ROS messages that are installed."""

from __future__ import annotations

import array
import ast
import sysconfig
from pathlib import Path

import pytest

from backend.language.message_stubs import stub_of, write_message_stubs

SITE_PACKAGES = Path(sysconfig.get_path("purelib"))


@pytest.fixture(scope="module")
def stubs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stubs")
    write_message_stubs(SITE_PACKAGES, folder)
    return folder


def members(stubs, package, name, kind="msg"):
    """The members of a class with their types."""
    tree = ast.parse((stubs / package / kind / "__init__.pyi").read_text())
    found = next(each for each in tree.body if isinstance(each, ast.ClassDef) and each.name == name)
    types = {}
    for each in found.body:
        if isinstance(each, ast.AnnAssign):
            types[ast.unparse(each.target)] = ast.unparse(each.annotation)
        elif isinstance(each, ast.FunctionDef) and each.returns and each.name != "__init__":
            types.setdefault(each.name, ast.unparse(each.returns))
        elif isinstance(each, ast.Assign):
            types[ast.unparse(each.targets[0])] = ast.unparse(each.value)
    return types


def test_fields_have_types(stubs):
    assert members(stubs, "geometry_msgs", "Twist") == {
        "linear": "geometry_msgs.msg.Vector3",
        "angular": "geometry_msgs.msg.Vector3",
    }
    scan = members(stubs, "sensor_msgs", "LaserScan")
    assert (scan["ranges"], scan["angle_min"], scan["header"]) == (
        "_array.array[float]",
        "float",
        "std_msgs.msg.Header",
    )
    assert members(stubs, "sensor_msgs", "Image")["data"] == "_array.array[int]"
    odometry = members(stubs, "geometry_msgs", "PoseWithCovariance")
    assert odometry["covariance"] == "_typing.NDArray[_numpy.float64]"
    assert members(stubs, "nav_msgs", "Path")["poses"] == "list[geometry_msgs.msg.PoseStamped]"


def test_arrays_of_numbers_have_the_types_that_the_classes_give_them():
    from geometry_msgs.msg import PoseWithCovariance
    from sensor_msgs.msg import Image, LaserScan

    assert isinstance(Image().data, array.array)
    assert isinstance(LaserScan().ranges, array.array)
    assert PoseWithCovariance().covariance.dtype == "float64"


def test_constants_and_services_are_there(stubs):
    assert "POWER_SUPPLY_STATUS_FULL" in members(stubs, "sensor_msgs", "BatteryState")
    assert members(stubs, "std_srvs", "Trigger", kind="srv")["Request"] == "Trigger_Request"


def test_every_stub_is_python_and_every_message_has_one(stubs):
    for path in stubs.rglob("*.pyi"):
        ast.parse(path.read_text())
    modules = {path.stem for path in (SITE_PACKAGES / "geometry_msgs" / "msg").glob("_*.py")} - {"__init__"}
    text = (stubs / "geometry_msgs" / "msg" / "__init__.pyi").read_text()
    assert text.count("\nclass ") == len(modules)


def test_a_folder_without_messages_has_no_stub(tmp_path):
    (tmp_path / "_empty.py").write_text("x = 1\n")
    assert stub_of(tmp_path) == ""
