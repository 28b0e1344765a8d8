"""The world as a process of its own: `python -m executor.world.process --channel-fd N`.

It is told what to do by messages on its channel, and answers by messages; `executor/session/protocol.py`
is the other end. The process may be started ahead of its use: it warms up, and waits for ``start``.
"""

from __future__ import annotations

import argparse
import logging
import os
import signal
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor.messages import CameraPose
from executor.ros.environment import has_tf, ros_environment
from executor.supervision.channel import Channel, ChannelClosed
from executor.supervision.confine import die_with_parent
from executor.supervision.pulse import Pulse
from executor.universes.document import DocumentError, Problem
from executor.world.interface import WorldError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

    from executor.render.interface import Renderer
    from executor.world.simulation.loop import SimulationLoop
    from executor.world.simulation.outside_graph import OutsideGraph

_log = logging.getLogger(__name__)

LONGEST_WAIT_S: Final = 0.25


class _Stop(Exception):  # noqa: N818 - the way out, not an error
    """The manager wants no more."""


class WorldProcess:
    """Receives messages and keeps the loop going, in one thread."""

    def __init__(self, channel: Channel, pulse: Pulse) -> None:
        self._channel = channel
        self._pulse = pulse
        self._loop: SimulationLoop | OutsideGraph | None = None
        self._renderer: Renderer | None = None
        self._context: Context | None = None
        self._close: list[Callable[[], None]] = []
        self._request: str | None = None
        """The token of the question that is being answered."""

    def run(self) -> None:
        """Works until it is told to stop, or the manager is gone."""
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
        """Loads now what `start` would otherwise have to wait for."""
        from executor.render import make_renderer  # noqa: PLC0415 - slow to load
        from executor.ros import node  # noqa: F401, PLC0415 - ROS reads the environment when it is loaded
        from executor.world.physics import bullet  # noqa: F401, PLC0415
        from executor.world.simulation import launch, loop  # noqa: F401, PLC0415

        self._renderer = make_renderer()
        self._context = self._join(int(os.environ.get("ROS_DOMAIN_ID", "0")))

    def _join(self, domain_id: int) -> Context:
        """Enters a ROS graph; the one of the environment is entered ahead of `start`."""
        if self._context is not None and self._context.get_domain_id() == domain_id:
            return self._context
        import rclpy  # noqa: PLC0415 - ROS reads the environment when it is loaded
        from rclpy.context import Context  # noqa: PLC0415

        context = Context()
        rclpy.init(context=context, domain_id=domain_id)
        self._close.append(context.try_shutdown)
        return context

    def _obey(self, message: dict[str, Any]) -> None:
        self._request = message.get("request")
        try:
            self._dispatch(message)
        except DocumentError as error:
            self._refuse(error.problems[0], error.file, more=len(error.problems) - 1)
        except (WorldError, ValueError, TypeError, KeyError, OSError) as error:
            _log.warning("%s is refused: %r", message["type"], error)
            code = getattr(error, "code", "bad_request")
            self._say_error(code, str(error) if self._request else f"{message['type']}: {error}")
        if self._request:
            self._say({"type": "answer"})
        self._request = None

    def _dispatch(self, message: dict[str, Any]) -> None:
        kind = message["type"]
        if kind == "stop":
            raise _Stop
        if kind == "start":
            self._channel.send({"type": "starting"})
            with self._pulse.busy("building the world"):
                self._start(message)
            return
        if self._loop is None:
            self._say_error("not_started", f"The world must be started before {kind!r}.")
            return
        self._command(self._loop, kind, message)

    def _command(self, loop: SimulationLoop | OutsideGraph, kind: str, message: dict[str, Any]) -> None:
        match kind:
            case "pause":
                loop.pause()
            case "resume":
                loop.resume()
            case "step":
                loop.step(float(message["dt_s"]))
            case "reset":
                with self._pulse.busy("resetting the world"):
                    loop.reset()
            case "set_speed":
                loop.set_speed(float(message["speed"]))
            case "stop_robot":
                loop.stop_robots()
            case "teleop":
                goes_on = bool(message.get("goes_on"))
                loop.teleop(float(message["linear"]), float(message["angular"]), goes_on=goes_on)
            case "move_body":
                loop.move_body(str(message["id"]), message["pose"])
            case "subscribe" | "unsubscribe" | "pace":
                self._stream(loop, kind, message)
            case "list_topics" | "echo_topic" | "publish_topic" | "describe_type":
                self._topics.obey(message)
            case _:
                self._say_error("unknown_message", f"The world knows no message {kind!r}.")

    def _stream(self, loop: SimulationLoop | OutsideGraph, kind: str, message: dict[str, Any]) -> None:
        match kind:
            case "unsubscribe":
                loop.streams.unsubscribe(message.get("client"), str(message["stream"]))
            case "pace":
                loop.streams.pace(message.get("client"), float(message["lost"]))
            case _:
                self._subscribe(loop, message)

    def _subscribe(self, loop: SimulationLoop | OutsideGraph, message: dict[str, Any]) -> None:
        pose = message.get("camera_pose")
        loop.streams.subscribe(
            message.get("client"),
            message["stream"],
            max_hz=float(message.get("max_hz") or 30.0),
            width=message.get("width"),
            camera_pose=None if pose is None else msgspec.convert(pose, CameraPose),
        )

    def _start(self, message: dict[str, Any]) -> None:
        if self._loop is not None:
            self._say_error("already_started", "The world is running already.")
            return
        if message["universe"] == "none":
            self._start_outside(message)
            return
        from executor.ros.mismatches import Mismatches  # noqa: PLC0415 - ROS reads the environment
        from executor.ros.node import WorldNode  # noqa: PLC0415
        from executor.ros.outlet import Outlet  # noqa: PLC0415
        from executor.ros.topics import Topics  # noqa: PLC0415
        from executor.world.sensing.sensors import Sensors  # noqa: PLC0415
        from executor.world.simulation.launch import make_world  # noqa: PLC0415
        from executor.world.simulation.loop import SimulationLoop  # noqa: PLC0415

        self._progress(0.2, "Building the world")
        assets = Path(message["assets"]) if message.get("assets") else None
        world = make_world(
            message["universe"],
            seed=int(message.get("seed") or 0),
            robot=message.get("robot"),
            assets=assets,
            file=message.get("file") or "",
        )
        self._close.append(world.close)
        renderer = self._renderer
        if renderer is None:
            raise ValueError("no renderer")
        sensors = Sensors(world, lambda: renderer)
        self._close.append(sensors.close)
        self._progress(0.6, "Joining the ROS graph")
        context = self._join(int(message.get("domain_id") or 0))
        renamed = {place.id: place.topics for place in world.universe.robots}
        true_poses = {place.id for place in world.universe.robots if place.ground_truth}
        outlet = Outlet()
        node = WorldNode(world, context, topics=renamed, true_poses=true_poses, outlet=outlet)
        self._close.append(node.close)
        self._topics = Topics(node.node, self._say, commands=node, outlet=outlet)
        loop = SimulationLoop(
            world, sensors, node, self._channel.send, speed=float(message.get("speed", 1.0))
        )
        loop.watchers += [self._topics.poll, Mismatches(node.node, self._channel.send).poll]
        loop.moved = self._moved
        self._loop = loop
        self._channel.send(
            {"type": "ready", "renderer": renderer.name, "tf": has_tf(), "universe": world.name}
        )

    def _start_outside(self, message: dict[str, Any]) -> None:
        from executor.ros.mismatches import Mismatches  # noqa: PLC0415 - ROS reads the environment
        from executor.ros.topics import Topics  # noqa: PLC0415
        from executor.world.simulation.outside_graph import OutsideGraph  # noqa: PLC0415

        self._progress(0.6, "Joining the outside ROS graph")
        outside = OutsideGraph(self._join(int(message.get("domain_id") or 0)), self._channel.send)
        self._close.append(outside.close)
        self._topics = Topics(outside.node, self._say)
        outside.watchers += [self._topics.poll, Mismatches(outside.node, self._channel.send).poll]
        self._loop = outside
        self._channel.send({"type": "ready", "renderer": "", "tf": has_tf(), "universe": "none"})

    def _moved(self, clocks: int) -> None:
        self._pulse.clocks = clocks
        self._pulse.moved()

    def _progress(self, fraction: float, text: str) -> None:
        self._channel.send({"type": "progress", "fraction": fraction, "message": text})

    def _refuse(self, problem: Problem, file: str, *, more: int) -> None:
        text = f"{file}:{problem.line}:{problem.column}: {problem.message}"
        if more:
            text += f" (and {more} more)"
        self._say_error(problem.code, text, problem.hint)

    def _say_error(self, code: str, text: str, hint: str = "") -> None:
        error = {"code": code, "message": text, "hint": hint}
        self._say({"type": "answer", "error": error} if self._request else {"type": "error", **error})
        self._request = None

    def _say(self, message: dict[str, Any]) -> None:
        """Sends a message, with the token of the question that it answers."""
        self._channel.send({**message, "request": self._request} if self._request else message)


def main(arguments: list[str] | None = None) -> None:
    """Runs a world for the manager at the other end of a channel."""
    parser = argparse.ArgumentParser(prog="python -m executor.world.process", description=__doc__)
    parser.add_argument("--channel-fd", type=int, required=True)
    options = parser.parse_args(arguments)
    die_with_parent()
    logging.basicConfig(level=logging.INFO, format="%(levelname)s %(name)s: %(message)s")
    for name, value in ros_environment(int(os.environ.get("ROS_DOMAIN_ID", "0"))).items():
        os.environ.setdefault(name, value)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the manager's to handle
    channel = Channel(options.channel_fd)
    WorldProcess(channel, Pulse(channel.send)).run()


if __name__ == "__main__":
    main()
