"""The simulated world: pictures beside TinyRenderer's, physics, lock-step, start, discovery, delivery."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executor.render import Viewpoint
from executor.render.gl import GlRenderer
from executor.render.tiny import TinyRenderer
from executor.ros.environment import ros_environment
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld
from tests.benchmarks.figures import Figure, of_parts, show
from tests.benchmarks.timing import median_ms

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

ROOT = Path(__file__).parents[2]
DOMAIN_ID = 34
SIZES = ((320, 240), (640, 480), (1280, 720))
PICTURES = 45
TURNS = 24


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields every figure; those of TinyRenderer are a rival's. `--parts lockstep` leaves the others out."""
    parts = {"pictures": pictures, "physics": physics, "lockstep": locksteps, "processes": processes}
    return of_parts(parts, options)


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


def pictures() -> Iterable[Figure]:
    """Draws the robot's camera with both renderers in turn, while the world moves."""
    for universe in ("person_in_green", "warehouse"):
        world = BulletWorld(load_builtin(universe))
        shapes = sum(len(thing.shapes) for thing in world.scene.objects)
        gl, tiny = GlRenderer(), TinyRenderer()
        for renderer in (gl, tiny):
            renderer.load(world.scene)
        for width, height in SIZES:
            times = _compare(world, gl, tiny, (width, height))
            middle = {name: statistics.median(values) for name, values in times.items()}
            for name, ms in middle.items():
                yield Figure(f"{universe}, {shapes} shapes, {width}×{height}, {name}", ms, "ms")
        gl.close()
        tiny.close()
        world.close()


def _compare(
    world: BulletWorld, gl: GlRenderer, tiny: TinyRenderer, size: tuple[int, int]
) -> dict[str, list[float]]:
    camera, robot = world.robots[0].config.cameras[0], world.robots[0]
    times: dict[str, list[float]] = {"plain": [], "smooth": [], "Tiny": [], "Tiny, shadows": []}
    for turn in range(TURNS):
        robot.command(0.2, 0.5)
        world.step(16)
        poses = world.poses()
        view = Viewpoint.of_pose(robot.camera_pose(camera), camera.fov, camera.near, camera.far)
        for name, values in times.items():
            is_ours = not name.startswith("Tiny")
            if not is_ours and turn % 6:
                continue
            tiny.has_shadows = name.endswith("shadows")
            renderer = gl if is_ours else tiny
            began_s = time.perf_counter()
            renderer.draw(poses, view, *size, smooth=name == "smooth")
            values.append((time.perf_counter() - began_s) * 1000)
    return times


def physics() -> Iterable[Figure]:
    """Times steps, scans and poses."""
    for universe in ("walled_room", "person_in_green"):
        world = BulletWorld(load_builtin(universe))
        robot = world.robots[0]
        robot.command(0.2, 0.5)
        step = median_ms(partial(world.step, 4), 500) / 4
        scan = median_ms(partial(robot.scan, robot.config.lidars[0]), 100)
        load = (step * 240 + scan * 10) / 10
        yield Figure(f"{universe}: a step", step * 1000, "µs")
        yield Figure(f"{universe}: a scan", scan, "ms")
        yield Figure(f"{universe}: physics in real time, of a core", load, "%")
        world.close()


def locksteps() -> Iterable[Figure]:
    """Runs both examples in lock-step."""
    yield from lockstep("laser_bump_and_go", 60)
    yield from lockstep("visual_follow_person", 20)


def lockstep(example: str, duration_s: float) -> Iterable[Figure]:
    """Runs an example in lock-step in a fresh process."""
    program = ROOT / "tests" / "executor" / "headless" / "lockstep_run.py"
    command = [sys.executable, str(program), str(ROOT / "examples" / example)]
    done = subprocess.run(
        [*command, str(duration_s), "1"],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
    )
    report = json.loads(done.stdout)["report"]
    what = f"lock-step {example}, {duration_s:.0f} s"
    yield Figure(f"{what}: speed", report["real_time_factor"], "×", "higher")
    yield Figure(f"{what}: distance", report["distance_m"], "m", "higher")
    yield Figure(f"{what}: collisions", report["collisions"], "")


def processes() -> Iterable[Figure]:
    """Starts a world and a plain rclpy program, and counts what arrives."""
    import msgspec

    from executor.supervision.channel import Channel, socket_pair

    environment = {**os.environ, **ros_environment(DOMAIN_ID), "PYTHONPATH": str(ROOT)}
    ours, theirs = socket_pair()
    command = [sys.executable, "-m", "executor.world.process", "--channel-fd", str(theirs.fileno())]
    with subprocess.Popen(command, pass_fds=[theirs.fileno()], env=environment) as world:
        theirs.close()
        channel: Channel[Any, Any] = Channel(ours.detach(), msgspec.msgpack.decode)
        ready_s = _start(channel)
        listener = str(ROOT / "tests/executor/ros/camera_listener.py")
        heard = subprocess.Popen(
            [sys.executable, listener, str(PICTURES)], env=environment, stdout=subprocess.PIPE, text=True
        )
        if heard.stdout is None:
            raise RuntimeError("the listener has no output")
        heard.stdout.readline()
        channel.send({"type": "resume"})
        said = json.loads(heard.communicate(timeout=120)[0])
        channel.send({"type": "stop"})
        world.wait(30)
        channel.close()
    stamps = said["stamps"]
    lost = round((stamps[-1] - stamps[0]) * 15) + 1 - len(stamps)
    yield Figure("world process, from a cold start to ready", ready_s, "s")
    yield Figure("discovery, from the later node's creation to the match", said["matched_s"], "s")
    yield Figure(f"pictures of 640×480 at 15 Hz lost, of {len(stamps)}", lost, "")


def _start(channel: Any) -> float:
    began_s = time.perf_counter()
    channel.send(
        {"type": "start", "universe": "walled_room", "seed": 1, "speed": 1.0, "domain_id": DOMAIN_ID}
    )
    while True:
        message = channel.receive(120)
        if message is None or message["type"] == "error":
            raise RuntimeError(f"the world did not start: {message}")
        if message["type"] == "ready":
            return time.perf_counter() - began_s


if __name__ == "__main__":
    main()
