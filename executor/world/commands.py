"""Obeys the commands of a session for a world, and answers them; in whichever process the world is."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from executor import child_messages
from executor.child_messages import Request, name_of
from executor.messages import Error
from executor.universes.document import DocumentError
from executor.world.interface import WorldError

if TYPE_CHECKING:
    from collections.abc import Callable

    from msgspec import Struct

    from executor.child_messages import FromWorld, WorldCommand
    from executor.navigation.node import Navigation
    from executor.ros.graph.topics import TopicReply, Topics
    from executor.supervision.pulse import Pulse
    from executor.universes.document import Problem
    from executor.world.simulation.loop import SimulationLoop
    from executor.world.simulation.outside_graph import OutsideGraph
    from executor.world.simulation.recording import WorldRecorder

__all__ = ["WorldCommands"]

_log = logging.getLogger(__name__)

StreamMessage = child_messages.Subscribe | child_messages.Unsubscribe | child_messages.Pace
TimeMessage = (
    child_messages.Pause | child_messages.Resume | child_messages.StepWorld | child_messages.SetSpeed
)


class WorldCommands:
    """Carries out commands for a world, one at a time, and answers each that asks for it.

    Args:
        send: sends a message to the session.
        pulse: notes long work.

    Attributes:
        loop: the world's loop; None before the world was started.
        topics: the topics of the world's graph; set with the loop.
        recorder: records the world, if anything does.
    """

    topics: Topics

    def __init__(self, send: Callable[[FromWorld], None], pulse: Pulse) -> None:
        self._send = send
        self._pulse = pulse
        self._request: str | None = None
        """The token of the request under way."""
        self.loop: SimulationLoop | OutsideGraph | None = None
        self.recorder: WorldRecorder | None = None
        self._navigation: Navigation | None = None
        self._navigators: list[str] = []

    def join(self, navigation: Navigation) -> None:
        """Takes the navigation of the world."""
        self._navigation = navigation
        navigation.expect(self._navigators)

    def answering(self, message: Struct, work: Callable[[], None]) -> None:
        """Does what a message asks for; answers it, also where that fails."""
        self._request = message.request if isinstance(message, Request) else None
        try:
            work()
        except DocumentError as error:
            self._refuse(error.problems[0], error.file, more=len(error.problems) - 1)
        except (WorldError, ValueError, TypeError, KeyError, OSError) as error:
            _log.warning("%s is refused: %r", name_of(message), error)
            code = getattr(error, "code", "bad_request")
            self.say_error(code, str(error) if self._request else f"{name_of(message)}: {error}")
        if self._request:
            self.answer(child_messages.Answer())
        self._request = None

    def obey(self, message: WorldCommand) -> None:
        """Carries out a command; its failures are exceptions, for `answering`."""
        if isinstance(message, child_messages.ExpectNavigators):  # also before the world was started
            self._expect(message.names)
            return
        loop = self.loop
        if loop is None:
            self.say_error("not_started", f"The world must be started before {name_of(message)!r}.")
            return
        match message:
            case child_messages.Reset():
                with self._pulse.busy("resetting the world"):
                    loop.reset()
            case child_messages.StopRobot():
                loop.stop_robots()
            case child_messages.Teleop():
                loop.teleop(message.linear, message.angular, goes_on=message.goes_on)
            case child_messages.MoveBody():
                loop.move_body(message.id, message.pose)
            case child_messages.Subscribe() | child_messages.Unsubscribe() | child_messages.Pace():
                self._stream(loop, message)
            case child_messages.BeginRecording():
                if self.recorder is not None:
                    self.recorder.begin(message.run)
            case (
                child_messages.ListTopics()
                | child_messages.EchoTopic()
                | child_messages.PublishTopic()
                | child_messages.DescribeType()
            ):
                self.topics.obey(message)
            case _:
                self._time(loop, message)

    def answer(self, message: child_messages.Answer | child_messages.WorldState | TopicReply) -> None:
        """Sends a message, with the token of the request that it answers, if there is one."""
        message.request = self._request
        self._send(message)

    def say_error(self, code: str, text: str, hint: str = "") -> None:
        """Sends an error, as the answer to the request under way, if there is one."""
        if self._request:
            self.answer(child_messages.Answer(error=Error(code, text, hint)))
        else:
            self._send(child_messages.Failed(code, text, hint))
        self._request = None

    def _expect(self, names: list[str]) -> None:
        self._navigators = names
        if self._navigation is not None:
            self._navigation.expect(names)

    @staticmethod
    def _time(loop: SimulationLoop | OutsideGraph, message: TimeMessage) -> None:
        match message:
            case child_messages.Pause():
                loop.pause()
            case child_messages.Resume():
                loop.resume()
            case child_messages.StepWorld():
                loop.step(message.dt_s)
            case child_messages.SetSpeed():
                loop.set_speed(message.speed)

    @staticmethod
    def _stream(loop: SimulationLoop | OutsideGraph, message: StreamMessage) -> None:
        match message:
            case child_messages.Subscribe():
                loop.streams.subscribe(
                    message.client,
                    message.stream,
                    max_hz=message.max_hz,
                    width=message.width,
                    camera_pose=message.camera_pose,
                    sensor=message.sensor,
                )
            case child_messages.Unsubscribe():
                loop.streams.unsubscribe(message.client, message.stream, sensor=message.sensor)
            case child_messages.Pace():
                loop.streams.pace(message.client, message.lost)

    def _refuse(self, problem: Problem, file: str, *, more: int) -> None:
        text = f"{file}:{problem.line}:{problem.column}: {problem.message}"
        if more:
            text += f" (and {more} more)"
        self.say_error(problem.code, text, problem.hint)
