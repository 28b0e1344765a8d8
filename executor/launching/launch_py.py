"""Runs one `.launch.py` of a project with ROS 2's own `launch`, if that is installed."""

from __future__ import annotations

import sys
from importlib import import_module


def main() -> int:
    """Runs the file with arguments (`name:=value`); returns the exit status of `launch`."""
    launch = import_module("launch")
    sources = import_module("launch.launch_description_sources")
    actions = import_module("launch.actions")
    service = launch.LaunchService()
    source = sources.PythonLaunchDescriptionSource(sys.argv[1])
    arguments = [tuple(word.split(":=", 1)) for word in sys.argv[2:]]
    include = actions.IncludeLaunchDescription(source, launch_arguments=arguments)
    service.include_launch_description(launch.LaunchDescription([include]))
    return int(service.run())


if __name__ == "__main__":
    sys.exit(main())
