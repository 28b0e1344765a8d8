"""The launch nodes of an application: starts, restarts and ends them, and reports their state."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final, NamedTuple

from executor import messages
from executor.child_messages import ExpectNavigators, Log
from executor.session.events import Retire, Spawn

if TYPE_CHECKING:
    from executor.launching.model import LaunchPlan, NodeSpec
    from executor.session.events import ChildExited, ChildSaid
    from executor.session.stage import Stage

__all__ = ["LaunchNodes"]

GRACE_S: Final = 1.0
_PLACED: Final = re.compile(r"(?P<file>[^/\s:][^\s:]*\.py):(?P<line>\d+): (?P<text>.+)")
"""The last line of a Python program of the project that an exception ended (`tree_gardener.ros_script`)."""


class _Place(NamedTuple):
    file: str
    line: int
    text: str = ""


@dataclass
class _Node:
    spec: NodeSpec
    number: int = 0
    """Number of the node's process; 0 if it has none."""
    state: messages.LaunchState = "ended"
    restarts: int = 0
    end: str = ""

    def to_message(self) -> messages.LaunchNode:
        spec = self.spec
        return messages.LaunchNode(
            id=spec.id,
            name=spec.name,
            package=spec.package,
            executable=spec.executable,
            file=spec.file,
            line=spec.line,
            state=self.state,
            restarts=self.restarts,
            end=self.end,
        )


class LaunchNodes:
    """All launch nodes of an application; they run as long as the application."""

    def __init__(self) -> None:
        self._nodes: dict[str, _Node] = {}
        self._folder = ""
        self._has_navigators = False

    def start(self, stage: Stage, plan: LaunchPlan) -> None:
        """Starts all nodes of the launch files."""
        self.stop(stage)
        self._folder = plan.folder
        for note in plan.notes:
            stage.output.emit(messages.Log("launch", "warning", note))
        had_nodes = bool(self._nodes)
        self._nodes = {spec.id: _Node(spec) for spec in plan.nodes}
        for node in self._nodes.values():
            if node.spec.refusal:
                self._refuse(stage, node)
            else:
                self._spawn(stage, node)
        if had_nodes or self._nodes:
            self._tell(stage)
        self._tell_world(stage)

    def stop(self, stage: Stage) -> None:
        """Ends all nodes; each has a second in which it may end by itself."""
        running = [node for node in self._nodes.values() if node.number]
        for node in running:
            self._retire(stage, node)
            node.state, node.end = "ended", "ended with the application"
        if running:
            self._tell(stage)

    def restart(self, stage: Stage, id_: str) -> str:
        """Restarts a node, whether it runs or not; returns the reason why it cannot, or ""."""
        node = self._nodes.get(id_)
        if node is None:
            return f"The launch files have no node {id_!r}."
        if node.spec.refusal:
            return f"{node.spec.name} {node.spec.refusal}"
        if node.number:
            self._retire(stage, node)
        node.restarts += 1
        self._spawn(stage, node)
        self._tell(stage)
        self._tell_world(stage)
        return ""

    def said(self, stage: Stage, event: ChildSaid) -> None:
        """Reports a line that a node printed."""
        node = self._of(event.number)
        if isinstance(event.message, Log):
            stage.output.emit(
                messages.Log(
                    "launch",
                    event.message.level,
                    event.message.text,
                    time=stage.sim_time_s,
                    launch_node=node.spec.id if node else "",
                )
            )

    def exited(self, stage: Stage, event: ChildExited) -> None:
        """Reports the exit of a node; a node that the session itself ended is ignored."""
        node = self._of(event.number)
        if node is None:
            return
        node.number, node.end = 0, event.reason
        is_well = event.reason.endswith("exit code 0")
        node.state = "ended" if is_well else "failed"
        if not is_well:
            place = _placed(event.last_lines, node.spec)
            stage.output.emit(
                messages.Fault(
                    "process",
                    f"The node {node.spec.name} {event.reason}{place.text}.",
                    hint="The run continues without it; restart it from the list of nodes.",
                    file=place.file,
                    line=place.line,
                    traceback="\n".join(event.last_lines),
                )
            )
        self._tell(stage)
        self._tell_world(stage)

    def _refuse(self, stage: Stage, node: _Node) -> None:
        spec = node.spec
        node.state, node.end = "failed", spec.refusal
        text = f"{spec.file}:{spec.line}: {spec.name} {spec.refusal}"
        stage.output.emit(messages.Log("launch", "warning", text, launch_node=spec.id))

    def _spawn(self, stage: Stage, node: _Node) -> None:
        node.number, node.state, node.end = stage.children.next_number(), "running", ""
        domain = ("ROS_DOMAIN_ID", str(stage.run.domain_id))
        spec = replace(node.spec, environment=(domain, *node.spec.environment))
        stage.output.effect(Spawn("node", node.number, spec, self._folder))

    def _retire(self, stage: Stage, node: _Node) -> None:
        stage.children.leaving.add(("node", node.number))
        stage.output.effect(Retire("node", node.number, GRACE_S))
        node.number = 0

    def _of(self, number: int) -> _Node | None:
        return next((node for node in self._nodes.values() if node.number == number), None)

    def _tell_world(self, stage: Stage) -> None:
        """Names the nodes whose navigation replaces that of the world."""
        running = [node.spec.name for node in self._nodes.values() if node.number and node.spec.may_navigate]
        if running or self._has_navigators:
            stage.children.tell_world(ExpectNavigators(running))
        self._has_navigators = bool(running)

    def _tell(self, stage: Stage) -> None:
        stage.output.emit(messages.LaunchNodes([node.to_message() for node in self._nodes.values()]))


def _placed(last_lines: tuple[str, ...], spec: NodeSpec) -> _Place:
    """Returns where the fault of a node is, and what it is; its line in the launch file if it is not said."""
    found = _PLACED.fullmatch(last_lines[-1]) if last_lines else None
    if found is None:
        return _Place(spec.file, spec.line)
    return _Place(found["file"], int(found["line"]), f": {found['text'].removesuffix('.')}")
