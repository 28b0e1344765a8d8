"""The world of an exact run, with its loop, in the process of the application."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from executor.application.randomness import seed_randomness
from executor.child_messages import Frame, Log
from executor.exact.loop import ExactLoop
from executor.headless.participants import Participants
from executor.headless.stepper import Stepper
from executor.render import make_renderer
from executor.ros.graph.mismatches import Mismatches
from executor.ros.graph.tap import GraphTap
from executor.ros.graph.topics import Topics
from executor.ros.node import WorldNode
from executor.ros.tap import BatchTap
from executor.world.sensing.sensors import Sensors
from executor.world.simulation.launch import make_world
from executor.world.simulation.recording import WorldRecorder

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from rclpy.context import Context

    from executor.child_messages import Sim, StartApplication, StartWorld
    from executor.world.commands import WorldCommands

__all__ = ["ExactWorld"]

GOODBYE_S = 0.2


class ExactWorld:
    """Builds a world as it was launched, or as another process left it.

    Args:
        start: the application with its world.
        tick: lets callbacks and tree do what is due now.
        is_ticking: whether the tree ticks.
        send: sends a message to the session.
        commands: takes the world's loop, and obeys commands for it.
        recorder: the address of the recorder; "" if nothing is recorded.
    """

    def __init__(  # noqa: PLR0913 - a world, and what it works for
        self,
        start: StartApplication,
        *,
        tick: Callable[[], None],
        is_ticking: Callable[[], bool],
        send: Callable[[Any], None],
        commands: WorldCommands,
        recorder: str,
    ) -> None:
        assert start.world is not None  # noqa: S101 - an exact run has one
        launch = start.world
        self.world = world = make_world(
            launch.universe,
            seed=launch.seed,
            robot=launch.robot,
            assets=Path(launch.assets) if launch.assets else None,
            file=launch.file,
        )
        if start.world_state:
            world.load(start.world_state)
        self._sensors = Sensors(world, make_renderer)
        self._tick_hz = start.tick_hz
        self._seed = start.seed
        self.ros = ros = Participants(world, self._make_node, self._let_time_pass)
        self._stepper = Stepper(world, self._sensors, ros.node)
        if ros.navigation is not None:
            self._stepper.parts.append(ros.navigation)
        self.loop = self._make_loop(launch, send, tick, is_ticking)
        self._topics = topics = Topics(ros.node.node, commands.answer, commands=ros.node)
        self.recorder = WorldRecorder(world, ros.node, BatchTap, recorder)
        self.recorder.join(partial(GraphTap, ros.context))
        self.loop.watchers += [self.recorder.look, topics.poll]
        self.loop.watchers.append(Mismatches(ros.application, send, patience=1).poll)
        commands.loop, commands.topics, commands.recorder = self.loop, topics, self.recorder

    @property
    def renderer_name(self) -> str:
        """The name of the renderer that is in use; "" before the first picture."""
        return self._sensors.renderer_name

    def reseed(self, seed: int) -> None:
        """Draws noise, and the random numbers of actions, from another seed from now on.

        The seed of the run itself changes nothing: what it draws continues.
        """
        self.world.reseed(seed)
        if seed != self._seed:
            self._seed = seed
            seed_randomness(seed)

    def forget_clients(self) -> None:
        """Ends all streams and echoes."""
        self.loop.streams.clear()
        self._topics.clear()

    def flush(self) -> None:
        """Sends the last of the recording."""
        self.recorder.flush(GOODBYE_S)

    def close(self) -> None:
        """Sends the last of the recording, and ends it."""
        self.flush()
        self.recorder.close()

    def _make_loop(
        self, launch: StartWorld, send: Callable[[Any], None], tick: Callable[[], None], is_ticking: Any
    ) -> ExactLoop:
        def tell(message: Sim | Log | Frame) -> None:
            if isinstance(message, Log):
                message.of_world = True
            send(message)
            if isinstance(message, Frame):
                self.recorder.picture(message)

        return ExactLoop(
            self.world,
            self._sensors,
            self.ros.node,
            tell,
            stepper=self._stepper,
            tick=tick,
            is_ticking=is_ticking,
            tick_hz=self._tick_hz,
            speed=launch.speed,
        )

    def _make_node(self, context: Context) -> WorldNode:
        return WorldNode.of_universe(self.world, context, clock_hz=self._tick_hz)

    def _let_time_pass(self) -> None:
        self.loop.let_time_pass()
