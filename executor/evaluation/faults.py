"""Faults of one run: when they happen is drawn before it, and they begin and end at steps of the world."""

from __future__ import annotations

import difflib
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.areas import draw_in
from executor.evaluation.clearance import MARGIN_M, radius_of
from executor.evaluation.drawing import draw_range, generator_of
from executor.ros.topic_faults import TopicFaults
from executor.universes.document import Problem
from executor.world.sensing.bumper import ZONES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from executor.evaluation.document import Fault
    from executor.evaluation.plan import Plan
    from executor.evaluation.run import EvaluationRun
    from executor.robots.config import RobotConfig
    from executor.universes.model import Universe
    from translator import Project

MOST_ATTEMPTS: Final = 200


@dataclass(frozen=True)
class Scheduled:
    """A fault that happens in a run, from `at_s` to `until_s` (the end, if None)."""

    fault: Fault
    address: str
    at_s: float
    until_s: float | None

    def to_json(self) -> dict[str, Any]:
        """Returns it as a JSON object."""
        until_s = None if self.until_s is None else round(self.until_s, 6)
        return {"fault": self.address, "at_s": round(self.at_s, 6), "until_s": until_s}


def schedule(faults: Sequence[Fault], seed: int) -> list[Scheduled]:
    """Draws which faults happen with a seed, and when.

    The draws of a fault depend on its kind, target and number among equals, so no fault changes another.
    """
    found: list[Scheduled] = []
    seen: dict[str, int] = {}
    for fault in faults:
        number = seen[fault.address] = seen.get(fault.address, 0) + 1
        address = fault.address if number == 1 else f"{fault.address}#{number}"
        if generator_of(seed, f"{address}.probability").random() >= fault.probability:
            continue
        at_s = draw_range(fault.at_s, seed, f"{address}.at_s")
        for_s = None if fault.for_s is None else draw_range(fault.for_s, seed, f"{address}.for_s")
        found.append(Scheduled(fault, address, at_s, None if for_s is None else at_s + for_s))
    return found


def sensor_topics(config: RobotConfig, sensor: str, renamed: Mapping[str, str]) -> list[str]:
    """Returns the topics of a sensor; empty if the robot has none of this name."""
    for lidar in config.lidars:
        if lidar.name == sensor:
            return [renamed.get(sensor, lidar.topic)]
    for camera in config.cameras:
        if camera.name == sensor:
            others = (camera.depth_topic, camera.info_topic, camera.depth_info_topic)
            return [renamed.get(sensor, camera.topic), *camera.aliases, *(topic for topic in others if topic)]
    for bumper in config.bumpers:
        if bumper.name == sensor:
            topic = renamed.get(sensor, bumper.topic)
            return [topic, *(f"{topic}/{zone}" for zone in ZONES)]
    rest_: list[Any] = [*config.imus, *config.batteries]
    rest = {each.name: str(each.topic) for each in rest_}
    return [renamed.get(sensor, rest[sensor])] if sensor in rest else []


def _sensors_of(config: RobotConfig) -> list[str]:
    all_: list[Any] = [*config.lidars, *config.cameras, *config.imus, *config.bumpers, *config.batteries]
    return [sensor.name for sensor in all_]


def topics_of(config: RobotConfig, renamed: Mapping[str, str]) -> list[str]:
    """Returns the topics of a robot that faults can change, without its prefix."""
    names = _sensors_of(config)
    found = [topic for name in names for topic in sensor_topics(config, name, renamed)]
    return ["/cmd_vel", "/odom", "/joint_states", *dict.fromkeys(found)]


def fault_problems(plan: Plan, place: Callable[..., tuple[int, int]]) -> Iterator[Problem]:
    """Yields the references of faults to things that do not exist."""
    for index, fault in enumerate(plan.evaluation.faults):
        found = _problem(plan, fault)
        if found is not None:
            name, message, known = found
            near = difflib.get_close_matches(str(getattr(fault, name)), known, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"there are: {', '.join(known) or 'none'}"
            yield Problem(message, *place(("faults", index, name)), "BTV005", hint)


def _problem(  # noqa: PLR0911 - one a field
    plan: Plan, fault: Fault
) -> tuple[str, str, list[str]] | None:
    """Returns field, message and known names for a wrong name in a fault, or None."""
    ids = [robot.id for robot in plan.universe.robots]
    if fault.robot is not None and fault.robot not in ids:
        return "robot", f"the world has no robot {fault.robot!r}", ids
    index = ids.index(fault.robot) if fault.robot is not None else 0
    config, renamed = plan.configs[index], plan.universe.robots[index].topics
    noisy = {each.name: each.noise_m for each in config.lidars}
    noisy |= {each.name: each.rate_noise + each.acceleration_noise for each in config.imus}
    sensors = _sensors_of(config)
    wheels = [*config.drive.left, *config.drive.right]
    if fault.sensor is not None and fault.sensor not in sensors:
        return "sensor", f"the robot has no sensor {fault.sensor!r}", sensors
    if fault.kind == "sensor_noise" and not noisy.get(fault.sensor or ""):
        return (
            "sensor",
            f"{fault.sensor!r} has no noise to multiply",
            [name for name, noise in noisy.items() if noise],
        )
    topics = [_prefix(plan.universe, index) + topic for topic in topics_of(config, renamed)]
    if fault.topic is not None and fault.topic not in topics:
        return "topic", f"{fault.topic!r} is not a topic of the robot", topics
    if fault.wheel is not None and fault.wheel not in wheels:
        return "wheel", f"the robot has no wheel {fault.wheel!r}", wheels
    if fault.area is not None and fault.area not in plan.universe.areas:
        return "area", f"the world has no area {fault.area!r}", list(plan.universe.areas)
    if fault.node is not None and len(nodes_named(plan.project, fault.node)) != 1:
        found = nodes_named(plan.project, fault.node)
        known = [f"{tree}.{node}" for tree, node in found] or _actions_of(plan.project)
        return (
            "node",
            f"{fault.node!r} names {'several actions' if found else 'no action'} of the project",
            known,
        )
    return None


def nodes_named(project: Project, name: str) -> list[tuple[str, str]]:
    """Returns tree and id of the actions of a name, an id, or a tree and an id."""
    return [
        (tree.id, node.id)
        for tree in project.trees.values()
        for node in tree.walk()
        if node.type in project.actions and name in {node.label, node.id, f"{tree.id}.{node.id}"}
    ]


def _actions_of(project: Project) -> list[str]:
    trees = project.trees.values()
    return [node.label for tree in trees for node in tree.walk() if node.type in project.actions]


def _prefix(universe: Universe, index: int) -> str:
    return "" if index == 0 else f"/{universe.robots[index].id}"


class Faults:
    """The faults of one run: call `act` after each step of the world.

    Args:
        plan: the evaluation.
        seed: the seed.
        run: the run, which is set up.
    """

    def __init__(self, plan: Plan, seed: int, run: EvaluationRun) -> None:
        self._plan = plan
        self._seed = seed
        self._run = run
        self._waiting = schedule(plan.evaluation.faults, seed)
        self._active: list[Scheduled] = []
        self._slips: dict[tuple[str, str], list[float]] = {}
        self._noises: dict[tuple[str, str], list[float]] = {}
        self._lights: list[float] = []
        self._generators: dict[str, Callable[[], float]] = {}
        self._topics = TopicFaults()
        self.happened: list[dict[str, Any]] = []
        if any(fault.sensor or fault.topic for fault in plan.evaluation.faults):
            run.node.change_messages(self._topics)

    def act(self, now_s: float) -> None:
        """Begins and ends the faults that are due."""
        if not self._waiting and not self._active:
            return
        for each in [
            each for each in self._active if each.until_s is not None and now_s >= each.until_s - 1e-9
        ]:
            self._active.remove(each)
            self._switch(each, on=False)
        for each in [each for each in self._waiting if now_s >= each.at_s - 1e-9]:
            self._waiting.remove(each)
            self._active.append(each)
            if self._switch(each, on=True):
                self.happened.append(each.to_json())

    def _switch(self, each: Scheduled, *, on: bool) -> bool:
        """Begins or ends a fault; returns whether it could."""
        fault = each.fault
        if fault.sensor is not None:
            self._switch_sensor(each, on=on)
        elif fault.topic is not None:
            self._switch_topic(each, on=on)
        elif fault.kind == "wheel_slip":
            factor = self._product(self._slips, fault, fault.wheel or "", on=on)
            self._robot(fault).slip(fault.wheel or "", factor)
        elif fault.kind == "wheel_stuck":
            self._robot(fault).block(fault.wheel or "", on=on)
        elif fault.kind == "light_change":
            _switch_in(self._lights, fault.factor or 0.0, on=on)
            self._run.world.scale_lights(math.prod(self._lights))
            self._run.sensors.load_scene()
        elif fault.kind == "action_raises":
            self._switch_action(fault, on=on)
        elif on and fault.kind == "kidnap":
            return self._kidnap(each)
        elif on:
            self._push(each)
        return True

    def _index(self, fault: Fault) -> int:
        ids = [robot.id for robot in self._run.world.robots]
        return 0 if fault.robot is None else ids.index(fault.robot)

    def _robot(self, fault: Fault) -> Any:
        return self._run.world.robots[self._index(fault)]

    def _switch_sensor(self, each: Scheduled, *, on: bool) -> None:
        fault, index = each.fault, self._index(each.fault)
        if fault.kind == "sensor_noise":
            self._robot(fault).scale_noise(
                fault.sensor or "", self._product(self._noises, fault, fault.sensor or "", on=on)
            )
            return
        place = self._plan.universe.robots[index]
        for topic in sensor_topics(self._plan.configs[index], fault.sensor or "", place.topics):
            name = _prefix(self._plan.universe, index) + topic
            change = self._topics.silence if fault.kind == "sensor_silent" else self._topics.freeze
            change(name, on=on)

    def _switch_topic(self, each: Scheduled, *, on: bool) -> None:
        fault = each.fault
        if fault.kind == "topic_delay":
            self._topics.delay(fault.topic or "", fault.delay_s or 0.0, on=on)
        else:
            self._topics.drop(fault.topic or "", fault.share or 0.0, self._draws(each.address), on=on)

    def _draws(self, address: str) -> Callable[[], float]:
        if address not in self._generators:
            self._generators[address] = generator_of(self._seed, f"{address}.messages").random
        return self._generators[address]

    def _product(
        self, factors: dict[tuple[str, str], list[float]], fault: Fault, name: str, *, on: bool
    ) -> float:
        held = factors.setdefault((self._robot(fault).id, name), [])
        _switch_in(held, fault.factor or 0.0, on=on)
        return math.prod(held)

    def _switch_action(self, fault: Fault, *, on: bool) -> None:
        [(tree_id, node_id)] = nodes_named(self._plan.project, fault.node or "")
        self._run.switch_action(tree_id, node_id, on=on)

    def _kidnap(self, each: Scheduled) -> bool:
        """Puts the robot elsewhere; returns whether there was a free place."""
        fault, robot, world = each.fault, self._robot(each.fault), self._run.world
        if fault.pose is not None:
            world.move_body(robot.id, fault.pose)
            return True
        start = world.universe.robots[self._index(fault)].pose
        generator = generator_of(self._seed, f"{each.address}.pose")
        corners = self._plan.universe.areas[fault.area or ""].corners
        for _ in range(MOST_ATTEMPTS):
            x, y = draw_in(corners, generator)
            yaw = float(generator.uniform(0, math.tau))
            if self._is_free(robot, x, y):
                world.move_body(robot.id, (x, y, *start[2:5], yaw))
                return True
        return False

    def _is_free(self, robot: Any, x: float, y: float) -> bool:
        """Returns whether a ball round a place, as large as the robot, touches nothing else."""
        world, bullet = self._run.world, self._run.world.bullet
        radius = radius_of(robot) + MARGIN_M
        ball = bullet.createMultiBody(
            0, bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=radius), -1, (x, y, robot.base_pose[2])
        )
        others = [uid for uids in world.solids().values() for uid in uids if uid != robot.uid]
        touches = any(bullet.getClosestPoints(ball, uid, 0.0) for uid in others)
        bullet.removeBody(ball)
        return not touches

    def _push(self, each: Scheduled) -> None:
        fault = each.fault
        x, y = fault.direction or (1.0, 0.0)
        size = (fault.impulse_n_s or 0.0) / math.hypot(x, y)
        self._robot(fault).push((x * size, y * size, 0.0))


def _switch_in(factors: list[float], factor: float, *, on: bool) -> None:
    factors.append(factor) if on else factors.remove(factor)
