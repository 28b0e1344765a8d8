"""Packages started by the real `launch`, of which there are no wheels.

    BT_STUDIO_LAUNCH_SOURCES=FOLDER python -m pytest tests/ros_launch

FOLDER holds checkouts of `launch`, `launch_ros` (branch `jazzy`) and `osrf_pycommon`, under these names.
Without the variable the report says that this part did not run; with a folder that lacks one, it fails.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

VARIABLE = "BT_STUDIO_LAUNCH_SOURCES"
PACKAGES = (
    "launch/launch",
    "launch/launch_xml",
    "launch/launch_yaml",
    "launch_ros/launch_ros",
    "osrf_pycommon",
)
GIVEN = os.environ.get(VARIABLE, "")
collect_ignore = [] if GIVEN else ["test_real_launch.py"]


def sources() -> dict[str, Path]:
    """The folders of the packages, by name."""
    folders = {Path(part).name: Path(GIVEN).absolute() / part for part in PACKAGES}
    missing = [str(folder) for folder in folders.values() if not (folder / "package.xml").is_file()]
    if missing:
        pytest.fail(f"{VARIABLE}={GIVEN} lacks {', '.join(missing)}", pytrace=False)
    return folders


def pytest_terminal_summary(terminalreporter):
    """Says so at the end, where it is seen."""
    if not GIVEN:
        terminalreporter.write_line(
            f"tests/ros_launch was NOT run: {VARIABLE} names no checkouts.", yellow=True
        )
