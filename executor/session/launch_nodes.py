"""The extra nodes of the application: what runs, what ended and why, and starting one again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from executor import messages
from executor.session.events import Retire, Spawn

if TYPE_CHECKING:
    from executor.launching.model import LaunchPlan, NodeSpec
    from executor.session.events import ChildExited, ChildSaid
    from executor.session.protocol import Session

__all__ = ["LaunchNodes"]

GRACE_S: Final = 1.0


@dataclass
class _Node:
    spec: NodeSpec
    number: int = 0
    """Of its process; 0 while there is none."""
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
    """They live while the application lives."""

    def __init__(self) -> None:
        self._nodes: dict[str, _Node] = {}
        self._folder = ""

    def start(self, session: Session, plan: LaunchPlan) -> None:
        """Starts all that the launch files ask for."""
        self.stop(session)
        self._folder = plan.folder
        for note in plan.notes:
            session.emit(messages.Log("launch", "warning", note))
        had_nodes = bool(self._nodes)
        self._nodes = {spec.id: _Node(spec) for spec in plan.nodes}
        for node in self._nodes.values():
            if node.spec.refusal:
                self._refuse(session, node)
            else:
                self._spawn(session, node)
        if had_nodes or self._nodes:
            self._tell(session)

    def stop(self, session: Session) -> None:
        """Ends all; they have a second to end by themselves."""
        running = [node for node in self._nodes.values() if node.number]
        for node in running:
            self._retire(session, node)
            node.state, node.end = "ended", "ended with the application"
        if running:
            self._tell(session)

    def restart(self, session: Session, id_: str) -> str:
        """Starts one again, running or not; returns why it cannot be, or ""."""
        node = self._nodes.get(id_)
        if node is None:
            return f"The launch files have no node {id_!r}."
        if node.spec.refusal:
            return f"{node.spec.name} {node.spec.refusal}"
        if node.number:
            self._retire(session, node)
        node.restarts += 1
        self._spawn(session, node)
        self._tell(session)
        return ""

    def said(self, session: Session, event: ChildSaid) -> None:
        """A node printed a line."""
        node = self._of(event.number)
        if event.message["type"] == "log":
            session.emit(
                messages.Log(
                    "launch",
                    event.message["level"],
                    event.message["text"],
                    time=session.sim_time_s,
                    launch_node=node.spec.id if node else "",
                )
            )

    def exited(self, session: Session, event: ChildExited) -> None:
        """A node's process ended, by itself if it is still known."""
        node = self._of(event.number)
        if node is None:
            return
        node.number, node.end = 0, event.reason
        is_well = event.reason.endswith("exit code 0")
        node.state = "ended" if is_well else "failed"
        if not is_well:
            message = f"The node {node.spec.name} {event.reason}."
            session.emit(
                messages.Fault(
                    "process",
                    message,
                    hint="The run goes on without it; start it again from the list of nodes.",
                    file=node.spec.file,
                    line=node.spec.line,
                    traceback="\n".join(event.last_lines),
                )
            )
        self._tell(session)

    def _refuse(self, session: Session, node: _Node) -> None:
        spec = node.spec
        node.state, node.end = "failed", spec.refusal
        text = f"{spec.file}:{spec.line}: {spec.name} {spec.refusal}"
        session.emit(messages.Log("launch", "warning", text, launch_node=spec.id))

    def _spawn(self, session: Session, node: _Node) -> None:
        node.number, node.state, node.end = session.next_number(), "running", ""
        domain = ("ROS_DOMAIN_ID", str(session.run.domain_id))
        spec = replace(node.spec, environment=(domain, *node.spec.environment))
        session.effect(Spawn("node", node.number, spec, self._folder))

    def _retire(self, session: Session, node: _Node) -> None:
        session.leaving.add(("node", node.number))
        session.effect(Retire("node", node.number, GRACE_S))
        node.number = 0

    def _of(self, number: int) -> _Node | None:
        return next((node for node in self._nodes.values() if node.number == number), None)

    def _tell(self, session: Session) -> None:
        session.emit(messages.LaunchNodes([node.to_message() for node in self._nodes.values()]))
