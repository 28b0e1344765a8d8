"""Stand-ins for ROS 2's `launch` and `launch_ros`, which have no wheels: they report what would be started.

They know the classes and arguments that our launch files use, and nothing else. `tests/ros_launch` compares
the command lines that they give with those of the real ones, from a checkout of these.
"""

from __future__ import annotations

import sys
import types
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


@dataclass(frozen=True)
class Process:
    """A process that would be started: an executable of a package, with its arguments."""

    package: str
    executable: str
    words: list[str]
    respawn: bool
    respawn_delay: float


@dataclass(frozen=True)
class Included:
    """A launch file that would be included, with its arguments."""

    path: Path
    configurations: dict[str, Any]


@dataclass
class Context:
    """launch.LaunchContext, with the results of the launch."""

    launch_configurations: dict[str, Any]
    processes: list[Process] = field(default_factory=list)
    included: list[Included] = field(default_factory=list)


class Entity:
    """Base of all entities."""

    def execute(self, context: Context) -> list[Entity] | None:
        raise NotImplementedError


@dataclass
class LaunchDescription(Entity):
    """launch.LaunchDescription."""

    entities: list[Entity]

    def execute(self, context: Context) -> list[Entity]:
        return self.entities


class DeclareLaunchArgument(Entity):
    """launch.actions.DeclareLaunchArgument."""

    def __init__(self, name: str, *, default_value: str, description: str) -> None:
        assert isinstance(name, str)
        assert isinstance(default_value, str)
        assert isinstance(description, str)
        self.name = name
        self.default_value = default_value

    def execute(self, context: Context) -> None:
        context.launch_configurations.setdefault(self.name, self.default_value)


class OpaqueFunction(Entity):
    """launch.actions.OpaqueFunction."""

    def __init__(self, *, function: Callable[[Context], list[Entity]]) -> None:
        self.function = function

    def execute(self, context: Context) -> list[Entity]:
        return self.function(context)


@dataclass
class GroupAction(Entity):
    """launch.actions.GroupAction: what its actions set is gone after it."""

    actions: list[Entity]

    def execute(self, context: Context) -> None:
        before = context.launch_configurations
        context.launch_configurations = dict(before)
        visit(self.actions, context)
        context.launch_configurations = before


@dataclass
class UnsetLaunchConfiguration(Entity):
    """launch.actions.UnsetLaunchConfiguration."""

    name: str

    def execute(self, context: Context) -> None:
        context.launch_configurations.pop(self.name, None)


@dataclass
class AnyLaunchDescriptionSource:
    """launch.launch_description_sources.AnyLaunchDescriptionSource."""

    launch_file_path: str


@dataclass
class IncludeLaunchDescription(Entity):
    """launch.actions.IncludeLaunchDescription."""

    launch_description_source: AnyLaunchDescriptionSource

    def execute(self, context: Context) -> None:
        path = Path(self.launch_description_source.launch_file_path)
        assert path.is_file(), path
        context.included.append(Included(path, dict(context.launch_configurations)))


@dataclass
class LaunchConfiguration:
    """launch.substitutions.LaunchConfiguration."""

    variable_name: str

    def perform(self, context: Context) -> str:
        return context.launch_configurations[self.variable_name]


@dataclass
class PushRosNamespace(Entity):
    """launch_ros.actions.PushRosNamespace."""

    namespace: str

    def execute(self, context: Context) -> None:
        base = context.launch_configurations.get("ros_namespace", "")
        whole = self.namespace if self.namespace.startswith("/") else f"{base.rstrip('/')}/{self.namespace}"
        context.launch_configurations["ros_namespace"] = whole


@dataclass
class SetParameter(Entity):
    """launch_ros.actions.SetParameter."""

    name: str
    value: Any

    def execute(self, context: Context) -> None:
        added(context, "global_params", ["-p", f"{self.name}:={self.value}"])


@dataclass
class SetParametersFromFile(Entity):
    """launch_ros.actions.SetParametersFromFile."""

    filename: str

    def execute(self, context: Context) -> None:
        added(context, "global_params", ["--params-file", str(Path(self.filename).absolute())])


@dataclass
class SetRemap(Entity):
    """launch_ros.actions.SetRemap."""

    src: str
    dst: str

    def execute(self, context: Context) -> None:
        added(context, "ros_remaps", ["-r", f"{self.src}:={self.dst}"])


def added(context: Context, name: str, words: list[str]) -> None:
    """Appends to a list that a group sees without changing that of the group around it."""
    values = context.launch_configurations
    values[name] = [*values.get(name, []), *words]


@dataclass(kw_only=True)
class Node(Entity):
    """launch_ros.actions.Node."""

    package: str
    executable: str
    name: str
    output: str
    arguments: Sequence[str]
    respawn: bool
    respawn_delay: float

    def execute(self, context: Context) -> None:
        values = context.launch_configurations
        words = [*self.arguments, "--ros-args", "-r", f"__node:={self.name}"]
        if "ros_namespace" in values:
            words += ["-r", f"__ns:={values['ros_namespace']}"]
        words += [*values.get("global_params", []), *values.get("ros_remaps", [])]
        context.processes.append(
            Process(self.package, self.executable, words, self.respawn, self.respawn_delay)
        )


def visit(entities: Sequence[Entity], context: Context) -> None:
    """Executes actions, and those that they return."""
    for entity in entities:
        visit(entity.execute(context) or [], context)


MODULES: dict[str, list[Any]] = {
    "launch": [LaunchDescription],
    "launch.actions": [
        DeclareLaunchArgument,
        GroupAction,
        IncludeLaunchDescription,
        OpaqueFunction,
        UnsetLaunchConfiguration,
    ],
    "launch.launch_description_sources": [AnyLaunchDescriptionSource],
    "launch.substitutions": [LaunchConfiguration],
    "launch_ros": [],
    "launch_ros.actions": [Node, PushRosNamespace, SetParameter, SetParametersFromFile, SetRemap],
}


def launch(monkeypatch: Any, path: Path, arguments: dict[str, str]) -> Context:
    """Reads a launch file and returns what it would start."""
    for name, members in MODULES.items():
        module = types.ModuleType(name)
        module.__dict__.update({member.__name__: member for member in members})
        monkeypatch.setitem(sys.modules, name, module)
    space: dict[str, Any] = {}
    exec(compile(path.read_text(), str(path), "exec"), space)  # noqa: S102 - as `launch` does
    context = Context(dict(arguments))
    visit([space["generate_launch_description"]()], context)
    return context
