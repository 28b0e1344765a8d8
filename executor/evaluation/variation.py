"""The variation of an evaluation: finds the values that addresses name, and draws them for a seed."""

from __future__ import annotations

import dataclasses
import difflib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.drawing import Value, bounds_of, draw_pose, draw_value
from executor.universes.document import Problem
from executor.universes.model import Universe
from executor.world.physics.randomize import draw as draw_random

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from executor.evaluation.document import Draw, Evaluation
    from executor.robots.config import RobotConfig
    from translator import Project

AXES: Final = ("x", "y", "z", "roll", "pitch", "yaw")
MOST_ATTEMPTS: Final = 200
_GROUPS: Final = ("models", "actors", "robots")
_SENSORS: Final = ("lidars", "cameras", "imus", "bumpers", "batteries")
_FIXED: Final = frozenset(
    {"name", "kind", "link", "topic", "info_topic", "aliases", "depth_topic", "depth_info_topic"}
)
_WHOLE: Final = ("int", "uint")
_REAL: Final = ("double", "float")


@dataclass(frozen=True)
class Target:
    """The value that an address names: `owner` is a group and an id, a tree and a node, or a sensor."""

    kind: str
    owner: tuple[str, ...]
    field: str
    axis: int = -1
    whole: bool = False
    real: bool = False

    @property
    def is_pose(self) -> bool:
        """Whether the value is a pose, or a part of one."""
        return self.field == "pose"


class InvalidRunError(Exception):
    """No world can be drawn for a seed; the text names the entry."""


@dataclass
class Drawn:
    """All that was drawn for one seed."""

    universe: Universe
    values: dict[str, Any] = field(default_factory=dict)
    ports: dict[tuple[str, str, str], str] = field(default_factory=dict)
    sensors: dict[str, dict[str, Value]] = field(default_factory=dict)

    def configured(self, config: RobotConfig) -> RobotConfig:
        """Returns the first robot's configuration with the drawn values of its sensors.

        Raises:
            ValueError: the sensor cannot have a value.
        """
        changed: dict[str, Any] = {
            group: tuple(
                type(sensor).model_validate({**sensor.model_dump(), **self.sensors.get(sensor.name, {})})
                for sensor in getattr(config, group)
            )
            for group in _SENSORS
        }
        return dataclasses.replace(config, **changed) if self.sensors else config

    def edited(self, project: Project) -> Project:
        """Returns the project with the drawn values of its ports."""
        for (tree_id, node_id, port), text in self.ports.items():
            tree = project.trees[tree_id]
            ports = {**tree.nodes[node_id].ports, port: text}
            project = project.with_tree(tree.edited(node_id, ports=ports))
        return project


def targets(universe: Universe, config: RobotConfig | None, project: Project) -> dict[str, list[Target]]:
    """Returns all addresses with the things that they name; an address of several things is ambiguous."""
    found: dict[str, list[Target]] = {"ground.friction": [Target("ground", (), "friction")]}
    named = [*_world_addresses(universe), *_sensor_addresses(config), *_port_addresses(project)]
    for address, target in named:
        known = found.setdefault(address, [])
        if target not in known:
            known.append(target)
    return found


def _world_addresses(universe: Universe) -> Iterator[tuple[str, Target]]:
    for group in _GROUPS:
        for index, thing in enumerate(getattr(universe, group)):
            owners = [f"{group}.{thing.id}"] + (["robot"] if group == "robots" and index == 0 else [])
            for owner in owners:
                yield from ((f"{owner}.{name}", target) for name, target in _things_of(group, thing))


def _sensor_addresses(config: RobotConfig | None) -> Iterator[tuple[str, Target]]:
    for kind in _SENSORS:
        for sensor in getattr(config, kind, ()):
            for name in type(sensor).model_fields.keys() - _FIXED:
                whole = isinstance(getattr(sensor, name), int)
                yield f"sensors.{sensor.name}.{name}", Target("sensor", (sensor.name,), name, whole=whole)


def _port_addresses(project: Project) -> Iterator[tuple[str, Target]]:
    for tree in project.trees.values():
        for node in tree.walk():
            model = project.model(node.type)
            ports = model.ports.items() if model else ()
            kinds = {name: port.type for name, port in ports if port.direction != "output"}
            called = project.trees.get(node.tree or "") if node.is_subtree else None
            kinds |= {port.name: port.type for port in (called.ports if called else ())}
            for port in {**kinds, **node.ports}:
                kind = kinds.get(port)
                whole, real = kind in _WHOLE, kind in _REAL
                target = Target("port", (tree.id, node.id), port, whole=whole, real=real)
                for name in dict.fromkeys([node.label, node.id]):
                    yield f"ports.{tree.id}.{name}.{port}", target


def _things_of(group: str, thing: Any) -> list[tuple[str, Target]]:
    owner = (group, thing.id)
    fields = type(thing).model_fields
    found = [(name, Target("thing", owner, name)) for name in ("mass", "friction", "speed") if name in fields]
    if "pose" in fields:
        found.append(("pose", Target("thing", owner, "pose")))
        found += [(f"pose.{axis}", Target("thing", owner, "pose", i)) for i, axis in enumerate(AXES)]
    return found


def resolve(
    evaluation: Evaluation,
    known: Mapping[str, list[Target]],
    universe: Universe,
    place: Callable[..., tuple[int, int]],
) -> tuple[dict[str, Target], list[Problem]]:
    """Returns the target of each entry of `vary`, and the problems of the other entries, before any run.

    The bounds of each entry are tried on the universe, so that a value that it cannot have is found now.
    """
    found: dict[str, Target] = {}
    problems: list[Problem] = []
    for address, draw in evaluation.vary.items():
        at = place(("vary", address))
        named = known.get(address, [])
        if len(named) != 1:
            problems.append(
                Problem(_how_many(address, named), *at, "BTV001", _candidates(address, named, known))
            )
            continue
        message = _misfit(named[0], draw, universe)
        if not message and named[0].kind != "port":
            message = _out_of_bounds(named[0], draw, universe)
        if message:
            problems.append(Problem(f"{address}: {message}", *at, "BTV002"))
            continue
        found[address] = named[0]
    twice: dict[Target, str] = {}
    for address, target in found.items():
        first = twice.setdefault(target, address)
        if first != address:
            text = f"{address} names the same value as {first}"
            problems.append(Problem(text, *place(("vary", address)), "BTV001"))
    return found, problems


def _how_many(address: str, named: list[Target]) -> str:
    return f"{address} names {'several nodes' if named else 'nothing'}"


def _candidates(address: str, named: list[Target], known: Mapping[str, list[Target]]) -> str:
    if named:
        ids = [f"ports.{target.owner[0]}.{target.owner[1]}.{target.field}" for target in named]
        return f"use an id: {', '.join(ids)}"
    near = difflib.get_close_matches(address, known, n=3, cutoff=0.5)
    return (
        f"did you mean {' or '.join(near)}?"
        if near
        else "addresses begin with robot., models., actors., robots., sensors., ground. or ports."
    )


def _misfit(target: Target, draw: Draw, universe: Universe) -> str:
    """Returns why a draw cannot give values of a target, or an empty text."""
    whole_pose = target.is_pose and target.axis < 0
    if whole_pose != (draw.area is not None):
        return (
            "a pose is drawn from an `area`" if whole_pose else "an `area` gives poses, and this is no pose"
        )
    if draw.area is not None and draw.area not in universe.areas:
        there = ", ".join(universe.areas) or "none; add `areas` to it"
        return f"the world has no area {draw.area!r}; it has: {there}"
    if target.kind != "port" and any(isinstance(value, str | bool) for value in draw.choice or ()):
        return "the value is a number"
    return ""


def _out_of_bounds(target: Target, draw: Draw, universe: Universe) -> str:
    if draw.area is not None or target.kind == "sensor":
        return ""  # sensors are tried with the robot's configuration
    for value in bounds_of(draw):
        document = universe.model_dump()
        _set(document, target, value)
        try:
            Universe.model_validate(document)
        except ValueError as error:
            return f"{value} is out of its bounds: {_first_line(error)}"
    return ""


def _first_line(error: ValueError) -> str:
    details: Any = getattr(error, "errors", list)()
    return str(details[0]["msg"]) if details else str(error)


def _set(document: dict[str, Any], target: Target, value: Any) -> None:
    if target.kind == "ground":
        document["ground"][target.field] = value
        return
    group, id_ = target.owner
    thing = next(each for each in document[group] if each["id"] == id_)
    if target.axis >= 0:
        pose = list(thing["pose"])
        pose[target.axis] = value
        value = tuple(pose)
    thing[target.field] = value


def draw_world(
    evaluation: Evaluation,
    found: Mapping[str, Target],
    universe: Universe,
    seed: int,
    overlaps: Callable[[Universe, str, frozenset[str]], bool],
) -> Drawn:
    """Draws the values of one seed: those of the universe's `random` first, then those of `vary`.

    Args:
        evaluation: the evaluation.
        found: the targets of its entries.
        universe: the universe, as written.
        seed: the seed.
        overlaps: returns whether a thing of a universe stands in another one, other than in those whose place
            is not yet drawn.

    Raises:
        InvalidRunError: a thing finds no free place.
    """
    drawn = Drawn(draw_random(universe, seed).model_copy(update={"random": {}}))
    document = drawn.universe.model_dump()
    poses = [address for address in evaluation.vary if found[address].is_pose]
    for address, draw in evaluation.vary.items():
        target = found[address]
        if not target.is_pose:
            value = draw_value(draw, seed, address, whole=target.whole and draw.uniform is not None)
            _keep(drawn, document, target, address, value)
    unplaced = [found[address].owner[1] for address in poses]
    for address in poses:
        target, draw = found[address], evaluation.vary[address]
        unplaced.remove(target.owner[1])
        for attempt in range(MOST_ATTEMPTS):
            value = _draw_place(draw, target, document, universe, seed, address, attempt)
            _keep(drawn, document, target, address, value)
            placed = Universe.model_validate(document)
            if target.owner[1] in unplaced or not overlaps(placed, target.owner[1], frozenset(unplaced)):
                break
        else:
            raise InvalidRunError(f"{address}: no free place in {MOST_ATTEMPTS} attempts")
    drawn.universe = Universe.model_validate(document)
    drawn.values = {address: drawn.values[address] for address in evaluation.vary}
    return drawn


def _draw_place(  # noqa: PLR0913, PLR0917 - all of these decide the place
    draw: Draw,
    target: Target,
    document: dict[str, Any],
    universe: Universe,
    seed: int,
    address: str,
    attempt: int,
) -> Any:
    if draw.area is None:
        return draw_value(draw, seed, address, attempt)
    group, id_ = target.owner
    before = next(each["pose"] for each in document[group] if each["id"] == id_)
    return draw_pose(draw, universe.areas[draw.area].corners, before, seed, address, attempt)


def _keep(drawn: Drawn, document: dict[str, Any], target: Target, address: str, value: Any) -> None:
    drawn.values[address] = list(value) if isinstance(value, tuple) else value
    if target.kind == "port":
        tree_id, node_id = target.owner
        drawn.ports[tree_id, node_id, target.field] = port_text(value, real=target.real)
    elif target.kind == "sensor":
        drawn.sensors.setdefault(target.owner[0], {})[target.field] = value
    else:
        _set(document, target, value)


def port_text(value: Value, *, real: bool = False) -> str:
    """Returns a drawn value as a port of a diagram holds it; with `real`, 2 is 2.0."""
    if real and isinstance(value, int) and not isinstance(value, bool):
        value = float(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)
