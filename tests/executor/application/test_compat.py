"""Modules that actions expect."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from executor.application.compat import ROS_PYTHON

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = """
from executor.application import compat
compat.install()
import cv_bridge, tree_tools, message_filters, tf2_ros
print("well")
"""


def test_they_are_importable_once_they_are_installed() -> None:
    command = [sys.executable, "-c", PROGRAM]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stdout == "well\n", done.stderr
    assert ROS_PYTHON.is_dir()
