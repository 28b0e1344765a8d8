"""Modules that actions expect: imported message modules, `cv_bridge`, `tree_tools`."""

from __future__ import annotations

import importlib
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Final

__all__ = ["install", "warm_up"]

MESSAGES: Final = (
    "actionlib_msgs.msg",
    "builtin_interfaces.msg",
    "diagnostic_msgs.msg",
    "geometry_msgs.msg",
    "nav_msgs.msg",
    "rosgraph_msgs.msg",
    "sensor_msgs.msg",
    "shape_msgs.msg",
    "std_msgs.msg",
    "std_srvs.srv",
    "stereo_msgs.msg",
    "tf2_msgs.msg",
    "trajectory_msgs.msg",
    "visualization_msgs.msg",
)
ROS_PYTHON: Final = Path(__file__).parents[1] / "ros_python"
LIBRARIES: Final = ("rclpy.executors", "rclpy.qos", "py_trees", "numpy", "cv2")


def warm_up() -> None:
    """Imports the modules that nearly every application uses.

    Actions of JdeRobot BT Studio `import geometry_msgs` and use `geometry_msgs.msg`, which only works after
    another import of the submodule.
    """
    for name in (*MESSAGES, *LIBRARIES):
        if find_spec(name.partition(".")[0]) is not None and find_spec(name) is not None:
            importlib.import_module(name)


def install() -> None:
    """Makes `tree_tools`, `cv_bridge` and the packages of `executor/ros_python` importable.

    Installed ROS packages take precedence.
    """
    import tree_gardener  # noqa: PLC0415 - not before ROS has its environment
    from tree_gardener import lazy, tree_tools  # noqa: PLC0415 - as above

    lazy.import_names(tree_gardener)  # so that a run that begins does not wait for them
    tree_tools.install()
    if find_spec("cv_bridge") is None:
        sys.modules["cv_bridge"] = importlib.import_module("executor.application.cv_bridge")
    if str(ROS_PYTHON) not in sys.path:
        sys.path.append(str(ROS_PYTHON))  # last: installed modules take precedence
