"""Message, service and action packages that have no wheel: their names and definitions.

`interfaces/<package>.txt` has a section `[kind/Name]` for each interface, in the syntax of ROS's own
interface files.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

FOLDER: Final = Path(__file__).with_name("interfaces")
# Packages in the order of their dependencies, each with the packages that it uses.
PACKAGES: Final[dict[str, tuple[str, ...]]] = {
    "tf2_msgs": ("geometry_msgs", "action_msgs"),
    "geographic_msgs": ("geometry_msgs", "unique_identifier_msgs"),
    "nav2_msgs": ("geographic_msgs", "geometry_msgs", "nav_msgs", "action_msgs"),
    "example_interfaces": ("action_msgs",),
    "control_msgs": ("geometry_msgs", "sensor_msgs", "trajectory_msgs", "action_msgs"),
    "vision_msgs": ("geometry_msgs",),
    "btcpp_ros2_interfaces": ("action_msgs",),
}
# Dependencies of every package, also for services and actions.
COMMON: Final = ("builtin_interfaces", "std_msgs", "service_msgs", "unique_identifier_msgs")

_SECTION: Final = re.compile(r"^\[((msg|srv|action)/\w+)\]$")


def definitions_of(package: str) -> dict[str, str]:
    """Returns the interface files of a package: text by path, as `msg/Name.msg`."""
    found: dict[str, list[str]] = {}
    path = ""
    for line in (FOLDER / f"{package}.txt").read_text(encoding="utf-8").splitlines():
        if section := _SECTION.match(line):
            path = f"{section[1]}.{section[2]}"
            found[path] = []
        elif path:
            found[path].append(_numbered(line, len(found[path])))
    return {path: "\n".join(lines).strip() + "\n" for path, lines in found.items()}


def _numbered(line: str, number: int) -> str:
    """Appends a comment with a number to the definition of a constant.

    Otherwise rosidl confuses equal constants in the parts of an action.
    """
    return f"{line}  # line {number}" if "=" in line else line


def needed_by(package: str) -> tuple[str, ...]:
    """Returns all packages whose interfaces a package needs, sorted by name."""
    needs = {*COMMON, *PACKAGES.get(package, ())}
    for name in PACKAGES.get(package, ()):
        needs |= {*needed_by(name)} if name in PACKAGES else set()
    return tuple(sorted(needs))
