"""A program: starts a launch file of the workspace as `ros2 launch` does, until it is interrupted."""

from __future__ import annotations

import sys

from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource


def main(path: str, *arguments: str) -> int:
    """Returns the status of the launch."""
    pairs = [tuple(argument.split(":=", maxsplit=1)) for argument in arguments]
    service = LaunchService(noninteractive=True)
    source = AnyLaunchDescriptionSource(path)
    service.include_launch_description(
        LaunchDescription([IncludeLaunchDescription(source, launch_arguments=pairs)])
    )
    return service.run()


sys.exit(main(*sys.argv[1:]))
