"""Makes the folder of the packages that a project's Python can import.

They are the engine, Python packages of ROS, and stubs of messages.

On localhost the folder is made in the data folder (`folder.py`); for containers it is made with their image:
`python -m backend.language.library SITE_PACKAGES REPOSITORY FOLDER`.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from backend.language import message_stubs, rclpy_types

if TYPE_CHECKING:
    from collections.abc import Mapping

ENGINE: Final = ("tree_gardener",)
# Python parts of ROS without wheels, under the names that actions import.
ROS_PYTHON: Final = "executor/ros_python"
RULES: Final = {
    # Most actions set `self.scan = None` until the first message arrives. This is not an error.
    "missing-union-attribute": "ignore",
}
# Actions of JdeRobot's projects import `tree_tools`; the engine installs it under that name.
_TREE_TOOLS: Final = "from tree_gardener.tree_tools import *\n"


def make_library(site_packages: Path, repository: Path, folder: Path) -> None:
    """Makes the folder.

    It gets links to the engine and to Python packages of ROS, type stubs, and an annotated rclpy.
    """
    folder.mkdir(parents=True)
    message_stubs.write_message_stubs(site_packages, folder)
    rclpy_types.write_annotated(site_packages, folder)
    for package in ENGINE:
        (folder / package).symlink_to(repository / package, target_is_directory=True)
    for offered in sorted((repository / ROS_PYTHON).iterdir()):
        if (offered / "__init__.py").is_file() and not (site_packages / offered.name).exists():
            (folder / offered.name).symlink_to(offered, target_is_directory=True)
    (folder / "tree_tools.py").write_text(_TREE_TOOLS)


def configuration(files: str, library: str, python: str) -> str:
    """Returns the `ty.toml` of the language server.

    It names the places of the project and of the packages that it can import.
    """
    environment = {
        "python": python,
        # Other actions are imported as `actions.<Name>` or by their bare name, as in the engine's loader.
        "root": [files, f"{files}/actions"],
        "extra-paths": [library],
    }
    return _table("environment", environment) + _table("rules", RULES)


def _table(name: str, values: Mapping[str, object]) -> str:
    # JSON strings and lists are valid TOML.
    return f"[{name}]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in values.items())


if __name__ == "__main__":
    make_library(*(Path(argument) for argument in sys.argv[1:4]))
