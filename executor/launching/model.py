"""Launch nodes, ready to be started."""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ["LaunchPlan", "NodeSpec"]


@dataclass(frozen=True)
class NodeSpec:
    """One launch node.

    Attributes:
        id: unique in the application.
        command: the program and its arguments; empty if it cannot be started; `refusal` says why.
        environment: variables set for it alone.
        file: the launch file in the project, with the line in `line`.
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


@dataclass(frozen=True)
class LaunchPlan:
    """All nodes of the launch files of an application; `notes` name what was left out."""

    nodes: tuple[NodeSpec, ...] = ()
    notes: tuple[str, ...] = field(default_factory=tuple)
    folder: str = ""
