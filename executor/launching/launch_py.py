"""Runs one `.launch.py` of a project with ROS 2's own `launch`, if that is installed."""

from __future__ import annotations

import sys
from importlib import import_module


def main() -> int:
    """Runs the file; returns the exit status of `launch`."""
    launch = import_module("launch")
    sources = import_module("launch.launch_description_sources")
    actions = import_module("launch.actions")
    service = launch.LaunchService()
    source = sources.PythonLaunchDescriptionSource(sys.argv[1])
    service.include_launch_description(launch.LaunchDescription([actions.IncludeLaunchDescription(source)]))
    return int(service.run())


if __name__ == "__main__":
    sys.exit(main())
