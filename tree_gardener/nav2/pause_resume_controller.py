"""PauseResumeController of Nav2."""

from enum import Enum
from typing import Any, Final

from tree_gardener import ControlNode, Port, Status
from tree_gardener.nav2.topics import service_class


class State(Enum):
    """The states of the controller."""

    RESUMED = "resumed"
    PAUSE_REQUESTED = "pause requested"
    ON_PAUSE = "on pause"
    PAUSED = "paused"
    RESUME_REQUESTED = "resume requested"
    ON_RESUME = "on resume"


NEXT: Final = {
    State.PAUSE_REQUESTED: State.ON_PAUSE,
    State.ON_PAUSE: State.PAUSED,
    State.RESUME_REQUESTED: State.ON_RESUME,
    State.ON_RESUME: State.RESUMED,
}
CHILD: Final = {State.RESUMED: 0, State.PAUSED: 1, State.ON_PAUSE: 2, State.ON_RESUME: 3}
REQUESTS: Final = (State.PAUSE_REQUESTED, State.RESUME_REQUESTED)


class PauseResumeController(ControlNode):
    """Ticks its first child, or while it is paused the second one; the third and fourth at the changes.

    Two services pause and resume it. It succeeds when the first child does, and fails when a child fails.

    Rule: Nav2's plugins/control/pause_resume_controller.cpp.
    """

    MARKS_RUNNING = True
    MIN_CHILDREN = 1
    MAX_CHILDREN = 4
    INPUT_PORTS = {
        "pause_service_name": Port(str, description="Name of the service that pauses."),
        "resume_service_name": Port(str, description="Name of the service that resumes."),
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.state = State.RESUMED
        self.ros: Any = None
        self.services: list[Any] = []

    def setup(self, **kwargs: Any) -> None:
        """Offers the two services."""
        self.ros = kwargs.get("node")
        if self.ros is None:
            return
        trigger = service_class("std_srvs", "Trigger")
        for port, answer in (("pause_service_name", self.pause), ("resume_service_name", self.resume)):
            self.services.append(self.ros.create_service(trigger, self.get_input(port), answer))

    def pause(self, _request: Any, response: Any) -> Any:
        """Answers a request to pause."""
        is_possible = self.state is not State.PAUSED
        return self.ask(response, State.PAUSE_REQUESTED, "already in state PAUSED", is_possible=is_possible)

    def resume(self, _request: Any, response: Any) -> Any:
        """Answers a request to resume."""
        is_possible = self.state is State.PAUSED
        return self.ask(response, State.RESUME_REQUESTED, "not in state PAUSED", is_possible=is_possible)

    def ask(self, response: Any, state: State, otherwise: str, *, is_possible: bool) -> Any:
        """Notes a request, or refuses it."""
        response.success = is_possible
        if is_possible:
            self.state = state
        else:
            response.message = f"PauseResumeController BT node {otherwise}"
        return response

    def update(self) -> Status:
        if self.state in REQUESTS:
            self.reset_children()
            self.change()
        index = CHILD[self.state]
        if self.child_count <= index:
            self.change()
            return Status.RUNNING
        status = self.tick_child(index)
        if status is Status.RUNNING:
            return status
        if status is Status.FAILURE or self.state is State.RESUMED:
            self.forget()
            return Status.FAILURE if status is Status.FAILURE else Status.SUCCESS
        self.change()
        return Status.RUNNING

    def change(self) -> None:
        """Changes to the next state, if this one ends by itself."""
        self.state = NEXT.get(self.state, self.state)

    def forget(self) -> None:
        """Begins resumed the next time, unless a request came meanwhile."""
        if self.state not in REQUESTS:
            self.state = State.RESUMED

    def halt(self) -> None:
        self.state = State.RESUMED
        super().halt()

    def shutdown(self) -> None:
        """Withdraws the services."""
        for service in self.services:
            self.ros.destroy_service(service)
        self.services.clear()
