"""Stand-ins for ROS 2's `launch` and `launch_ros`, of which there are no wheels; they note what is asked.

They know the names and the arguments of the real classes that our launch file uses, and nothing else.
"""

from __future__ import annotations

import sys
import types
from typing import Any


class Entity:
    """Base of all: keeps its arguments."""

    def __init__(self, **values: Any) -> None:
        self.values = values


class DeclareLaunchArgument(Entity):
    """launch.actions.DeclareLaunchArgument."""

    def __init__(
        self, name: str, *, default_value: str | None = None, description: str | None = None
    ) -> None:
        assert default_value is None or isinstance(default_value, str)
        super().__init__(name=name, default_value=default_value, description=description)


class IncludeLaunchDescription(Entity):
    """launch.actions.IncludeLaunchDescription."""

    def __init__(self, launch_description_source: Entity, *, launch_arguments: Any = None) -> None:
        super().__init__(source=launch_description_source, arguments=launch_arguments)


class AnyLaunchDescriptionSource(Entity):
    """launch.launch_description_sources.AnyLaunchDescriptionSource."""

    def __init__(self, launch_file_path: str) -> None:
        super().__init__(path=launch_file_path)


class LaunchConfiguration(Entity):
    """launch.substitutions.LaunchConfiguration."""

    def __init__(self, variable_name: str, *, default: str | None = None) -> None:
        super().__init__(name=variable_name, default=default)


class LaunchDescription(Entity):
    """launch.LaunchDescription."""

    def __init__(self, initial_entities: list[Entity] | None = None) -> None:
        super().__init__(entities=list(initial_entities or []))


class ParameterValue(Entity):
    """launch_ros.parameter_descriptions.ParameterValue."""

    def __init__(self, value: Any, *, value_type: type | None = None) -> None:
        super().__init__(value=value, value_type=value_type)


class Node(Entity):
    """launch_ros.actions.Node."""

    def __init__(
        self, *, package: str, executable: str, name: str, output: str, parameters: list[Any]
    ) -> None:
        super().__init__(
            package=package, executable=executable, name=name, output=output, parameters=parameters
        )


MODULES = {
    "launch": {"LaunchDescription": LaunchDescription},
    "launch.actions": {
        "DeclareLaunchArgument": DeclareLaunchArgument,
        "IncludeLaunchDescription": IncludeLaunchDescription,
    },
    "launch.launch_description_sources": {"AnyLaunchDescriptionSource": AnyLaunchDescriptionSource},
    "launch.substitutions": {"LaunchConfiguration": LaunchConfiguration},
    "launch_ros": {},
    "launch_ros.actions": {"Node": Node},
    "launch_ros.parameter_descriptions": {"ParameterValue": ParameterValue},
}


def install(monkeypatch: Any) -> None:
    """Makes the stand-ins importable for one test."""
    for name, members in MODULES.items():
        module = types.ModuleType(name)
        module.__dict__.update(members)
        monkeypatch.setitem(sys.modules, name, module)
