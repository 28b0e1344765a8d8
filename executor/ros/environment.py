"""Defines the environment variables with which a process joins a session's ROS graph.

Set them before `rclpy` is imported.
"""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Final

FASTDDS_PROFILE: Final = Path(__file__).with_name("fastdds.xml")
LOCKSTEP_PROFILE: Final = Path(__file__).with_name("lockstep.xml")


def ros_environment(domain_id: int) -> dict[str, str]:
    """Returns the variables with which a process joins a session's graph on this host."""
    return {
        "ROS_DOMAIN_ID": str(domain_id),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
        "FASTDDS_DEFAULT_PROFILES_FILE": str(FASTDDS_PROFILE),
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(FASTDDS_PROFILE),
        "RCUTILS_COLORIZED_OUTPUT": "0",
    }


def lockstep_environment() -> dict[str, str]:
    """Returns the variables of a process whose graph is isolated from all others."""
    profile = str(LOCKSTEP_PROFILE)
    names = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
    return ros_environment(0) | dict.fromkeys(names, profile)


def use_lockstep_environment() -> None:
    """Sets the variables of `lockstep_environment` in this process, unless ROS was loaded before."""
    if "rclpy" not in sys.modules:
        os.environ.update(lockstep_environment())


def has_tf() -> bool:
    """Returns whether `tf2_msgs` was built at set-up; without it `/tf` is left out."""
    return find_spec("tf2_msgs") is not None
