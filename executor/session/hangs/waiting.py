"""Reports the action in which a tick takes long, and its return; `watch` reports it as a hang after 2 s."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.messages import Waiting
from executor.session.ladder import State

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.stage import Stage

__all__ = ["beat"]


def beat(stage: Stage, child: Child) -> None:
    """Compares a beat of the application with what clients know."""
    if child is not stage.children.get("application"):
        return
    waiting = Waiting()
    vitals = child.vitals
    if stage.state is State.APPLICATION_RUNNING and vitals.is_in_action and not vitals.task:
        place = vitals.place
        waiting = Waiting(place.text, place.node_id, place.node_path)
    if waiting != stage.mirror.waiting:
        stage.output.emit(waiting)
