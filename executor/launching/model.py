"""Launch nodes, ready to be started."""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ["LaunchPlan", "NodeSpec"]


@dataclass(frozen=True)
class NodeSpec:
    """One launch node.

    Attributes:
        id: its id, unique in the application.
        command: the program and its arguments; empty if the node cannot be started; `refusal` is then the
            reason.
        environment: environment variables that are set for this node only.
        file: the path of the launch file in the project; `line` is the line in it.
        may_navigate: whether it may offer the robot's navigation, as Nav2 does.
    """

    id: str
    name: str
    package: str
    executable: str
    file: str
    line: int
    command: tuple[str, ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    refusal: str = ""
    may_navigate: bool = False


@dataclass(frozen=True)
class LaunchPlan:
    """All launch nodes of an application; `notes` are about elements that were left out."""

    nodes: tuple[NodeSpec, ...] = ()
    notes: tuple[str, ...] = field(default_factory=tuple)
    folder: str = ""
