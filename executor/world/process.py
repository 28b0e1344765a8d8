"""The world as a process of its own: `python -m executor.world.process --channel-fd N`.

It exchanges messages (`executor.child_messages`) with the session on its channel. The process may be started
as a spare: it then loads slow modules, and waits for the message ``start``.
"""

from __future__ import annotations

import argparse
import logging
import os
import signal
import sys
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor import child_messages
from executor.child_messages import FromWorld, StartWorld, ToWorld, decode_to_world
from executor.recorder.link import ADDRESS_VARIABLE
from executor.ros.environment import has_tf, ros_environment
from executor.run_inputs import noted
from executor.supervision.channel import Channel, ChannelClosed, ChannelError
from executor.supervision.confine import die_with_parent
from executor.supervision.pulse import Pulse
from executor.world.commands import WorldCommands
from executor.world.interface import WorldError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

    from executor.render.interface import Renderer
    from executor.world.simulation.loop import SimulationLoop
    from executor.world.simulation.outside_graph import OutsideGraph
    from executor.world.simulation.recording import WorldRecorder

_log = logging.getLogger(__name__)

LONGEST_WAIT_S: Final = 0.25


class _Stop(Exception):  # noqa: N818 - the way out, not an error
    """Raised when the manager stops the world."""


class WorldProcess:
    """Receives messages and runs the simulation loop, in one thread."""

    def __init__(self, channel: Channel[FromWorld, ToWorld], pulse: Pulse) -> None:
        self._channel = channel
        self._pulse = pulse
        self._loop: SimulationLoop | OutsideGraph | None = None
        self._simulation: SimulationLoop | None = None
        self._renderer: Renderer | None = None
        self._context: Context | None = None
        self._close: list[Callable[[], None]] = []
        self._recorder: WorldRecorder | None = None
        self._commands = WorldCommands(channel.send, pulse)

    def run(self) -> None:
        """Runs until the world is stopped or the manager has ended."""
        try:
            self._warm_up()
            self._pulse.rests()
            while True:
                self._turn()
        except (_Stop, ChannelClosed):
            pass
        finally:
            for close in reversed(self._close):
                close()

    def _turn(self) -> None:
        self._pulse.moved()
        loop = self._loop
        wait_s = LONGEST_WAIT_S if loop is None else loop.next_due_s(time.monotonic())
        message = self._channel.receive(min(wait_s, LONGEST_WAIT_S))
        while message is not None:
            self._obey(message)
            message = self._channel.receive(0)
        if self._loop is not None:
            self._loop.run_due(time.monotonic())

    def _warm_up(self) -> None:
        """Loads modules in advance, so that `start` does not have to wait for them."""
        from executor.render import make_renderer  # noqa: PLC0415 - slow to load
        from executor.ros import node  # noqa: F401, PLC0415 - ROS reads the environment when it is loaded
        from executor.world.physics import bullet  # noqa: F401, PLC0415
        from executor.world.simulation import launch, loop, recording  # noqa: F401, PLC0415

        self._renderer = make_renderer()
        self._context = self._join(int(os.environ.get("ROS_DOMAIN_ID", "0")))

    def _join(self, domain_id: int) -> Context:
        """Returns the context of a ROS graph.

        A spare has joined the graph of its environment before `start`.
        """
        if self._context is not None and self._context.get_domain_id() == domain_id:
            return self._context
        import rclpy  # noqa: PLC0415 - ROS reads the environment when it is loaded
        from rclpy.context import Context  # noqa: PLC0415

        context = Context()
        rclpy.init(context=context, domain_id=domain_id)
        self._close.append(context.try_shutdown)
        return context

    def _obey(self, message: ToWorld) -> None:
        self._commands.answering(message, lambda: self._dispatch(message))

    def _dispatch(self, message: ToWorld) -> None:
        if isinstance(message, child_messages.Stop):
            raise _Stop
        if isinstance(message, StartWorld):
            self._channel.send(child_messages.Starting())
            with self._pulse.busy("building the world"):
                self._start(message)
            return
        if isinstance(message, child_messages.DumpWorld):
            self._dump()
        elif isinstance(message, child_messages.LoadWorld):
            self._load(message.data)
        else:
            self._commands.obey(message)
            if self._recorder is not None and (done := noted(message)) is not None:
                self._recorder.did(child_messages.name_of(message), done)

    def _dump(self) -> None:
        if self._simulation is None:
            raise WorldError("there is no simulated world")
        self._commands.answer(child_messages.WorldState(data=self._simulation.dump()))

    def _load(self, data: bytes) -> None:
        if self._simulation is not None:
            self._simulation.load(data)

    def _start(self, message: StartWorld) -> None:
        if self._loop is not None:
            self._commands.say_error("already_started", "The world is running already.")
            return
        if message.universe == "none":
            self._start_outside(message)
            return
        from executor.navigation.start import make_navigation  # noqa: PLC0415
        from executor.ros.graph.mismatches import Mismatches  # noqa: PLC0415
        from executor.ros.graph.tap import GraphTap  # noqa: PLC0415 - ROS reads the environment
        from executor.ros.graph.topics import Topics  # noqa: PLC0415
        from executor.ros.node import WorldNode  # noqa: PLC0415
        from executor.ros.outlet import Outlet  # noqa: PLC0415
        from executor.ros.tap import BatchTap  # noqa: PLC0415
        from executor.world.sensing.sensors import Sensors  # noqa: PLC0415
        from executor.world.simulation.launch import make_world  # noqa: PLC0415
        from executor.world.simulation.loop import SimulationLoop  # noqa: PLC0415
        from executor.world.simulation.recording import WorldRecorder  # noqa: PLC0415

        self._progress(0.2, "Building the world")
        assets = Path(message.assets) if message.assets else None
        world = make_world(
            message.universe, seed=message.seed, robot=message.robot, assets=assets, file=message.file
        )
        self._close.append(world.close)
        renderer = self._renderer
        if renderer is None:
            raise ValueError("no renderer")
        sensors = Sensors(world, lambda: renderer)
        self._close.append(sensors.close)
        self._progress(0.6, "Joining the ROS graph")
        context = self._join(message.domain_id)
        outlet = Outlet()
        node = WorldNode.of_universe(world, context, outlet=outlet)
        self._close.append(node.close)
        self._commands.topics = topics = Topics(
            node.node, self._commands.answer, commands=node, outlet=outlet
        )
        recorder = WorldRecorder(world, node, BatchTap, os.environ.get(ADDRESS_VARIABLE, ""))
        recorder.join(partial(GraphTap, context))
        self._close.append(recorder.close)
        self._recorder = self._commands.recorder = recorder
        loop = SimulationLoop(world, sensors, node, self._send_frame, speed=message.speed)
        loop.watchers += [recorder.look, topics.poll, Mismatches(node.node, self._channel.send).poll]
        loop.moved = self._moved
        if (navigation := make_navigation(world, context, outlet)) is not None:
            self._close.append(navigation.close)
            loop.parts.append(navigation)
            self._commands.join(navigation)
        self._loop = self._commands.loop = self._simulation = loop
        self._channel.send(child_messages.WorldReady(renderer.name, has_tf(), world.name))

    def _start_outside(self, message: StartWorld) -> None:
        from executor.ros.graph.mismatches import Mismatches  # noqa: PLC0415 - ROS reads the environment
        from executor.ros.graph.topics import Topics  # noqa: PLC0415
        from executor.world.simulation.outside_graph import OutsideGraph  # noqa: PLC0415

        self._progress(0.6, "Joining the outside ROS graph")
        outside = OutsideGraph(self._join(message.domain_id), self._channel.send)
        self._close.append(outside.close)
        self._commands.topics = topics = Topics(outside.node, self._commands.answer)
        outside.watchers += [topics.poll, Mismatches(outside.node, self._channel.send).poll]
        self._loop = self._commands.loop = outside
        self._channel.send(child_messages.WorldReady("", has_tf(), "none"))

    def _send_frame(self, message: child_messages.Sim | child_messages.Log | child_messages.Frame) -> None:
        """Sends a message of the loop; pictures that a client subscribes to are recorded too."""
        self._channel.send(message)
        if isinstance(message, child_messages.Frame) and self._recorder is not None:
            self._recorder.picture(message)

    def _moved(self, clocks: int) -> None:
        self._pulse.clocks = clocks
        self._pulse.moved()

    def _progress(self, fraction: float, text: str) -> None:
        self._channel.send(child_messages.Progress(fraction, text))


def main(arguments: list[str] | None = None) -> None:
    """Runs a world for the manager at the other end of a channel."""
    parser = argparse.ArgumentParser(prog="python -m executor.world.process", description=__doc__)
    parser.add_argument("--channel-fd", type=int, required=True)
    options = parser.parse_args(arguments)
    die_with_parent()
    logging.basicConfig(level=logging.INFO, format="%(levelname)s %(name)s: %(message)s")
    for name, value in ros_environment(int(os.environ.get("ROS_DOMAIN_ID", "0"))).items():
        os.environ.setdefault(name, value)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the manager handles Ctrl-C
    channel: Channel[FromWorld, ToWorld] = Channel(options.channel_fd, decode_to_world)
    try:
        WorldProcess(channel, Pulse(channel.send)).run()
    except ChannelError as error:
        sys.exit(f"The manager sent a message that cannot be read: {error}")


if __name__ == "__main__":
    main()
