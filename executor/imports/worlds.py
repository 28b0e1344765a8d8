"""Converts an SDF world to a universe with its meshes, and lists the elements that were left out."""

from __future__ import annotations

import itertools
import math
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

import yaml
from pydantic import ValidationError

from executor.imports.heightmaps import heightmap_mesh
from executor.imports.links import parts_of
from executor.imports.materials import color_of
from executor.imports.meshes import Meshes
from executor.robots.sdf_model import Joint, SdfUrdf, joints_of, links_of
from executor.sdf.dialect import SdfError
from executor.sdf.files import NoFiles
from executor.sdf.includes import load, problem_at
from executor.sdf.scopes import Scope
from executor.sdf.values import is_true, numbers, pose_in, rounded, text_of
from executor.universes.document import Problem
from executor.universes.loader import UniverseError, parse_universe
from executor.universes.model import Actor, Light, Model
from executor.world.geometry.transforms import Pose, compose, rotate, to_xyz_rpy
from translator.yaml_core import CoreDumper

if TYPE_CHECKING:
    from collections.abc import Iterator

    from lxml import etree

    from executor.imports.links import Part
    from executor.sdf.files import Files

MOST_THINGS: Final = 2_000
MOST_ACTORS: Final = 100
MOST_LIGHTS: Final = 4
MOST_POINTS: Final = 10_000
"""Points of all actors' paths together."""
_MODEL_QUIET: Final = frozenset(
    {"pose", "static", "link", "joint", "frame", "model", "self_collide", "allow_auto_disable", "enable_wind"}
)
_WORLD_QUIET: Final = frozenset({"model", "light", "actor", "frame", "gravity"})
_ACTOR_QUIET: Final = frozenset({"pose", "skin", "animation", "script", "static"})


@dataclass
class Imported:
    """A universe's document as YAML, the files that it needs, and what of the SDF world was left out."""

    text: str
    left_out: list[Problem] = field(default_factory=list)
    files: dict[str, bytes] = field(default_factory=dict)
    things: int = 0


def import_sdf(
    data: bytes,
    file: str = "world.sdf",
    files: Files | None = None,
    *,
    name: str = "",
    simplify: bool = False,
) -> Imported:
    """Returns the universe of an SDF world.

    Args:
        data: the world.
        file: its path, from which others are found.
        files: the models and meshes that it may name.
        name: the folder in `assets/` for meshes and models; made from the file's name if it is "".
        simplify: whether meshes of too many triangles are made smaller, instead of being left out.

    Raises:
        UniverseError: the document is not an SDF, or nothing of it can be imported.
    """
    shown = re.split(r"[/\\]", file)[-1]
    name = re.sub(r"[^A-Za-z0-9_-]+", "_", name or shown.rpartition(".")[0] or shown)[:60] or "world"
    try:
        return _World(file, files or NoFiles(), f"assets/{name}", simplify=simplify).imported(data)
    except SdfError as error:
        problem = error.problem
        if error.file != file:
            problem = Problem(f"{error.file}: {problem.message}", problem.line, code=problem.code)
        raise UniverseError([problem], shown) from error


class _World:
    def __init__(self, file: str, files: Files, folder: str, *, simplify: bool) -> None:
        self._left_out: dict[tuple[int, str], Problem] = {}
        self._file = file
        self._files = files
        self._folder = folder
        self._ids: set[str] = {"ground", "robot", "ceiling"}
        self._meshes = Meshes(files, folder, self._skip, simplify=simplify)
        self._lights: list[dict[str, Any]] = []
        self._points = MOST_POINTS

    def _title(self, world: etree._Element) -> str:
        """Returns the world's name; most are called `default`, and have that of their file."""
        name = (world.get("name") or "").strip()[:120]
        return name if name not in ("", "default") else self._folder.rpartition("/")[2]

    def imported(self, data: bytes) -> Imported:
        """Reads the world."""
        root = load(data, self._file, self._files, self._skip)
        element = root.find("world")
        if element is None:
            raise SdfError("there is no <world> in an <sdf> element", self._file)
        for other in root.findall("world")[1:]:
            self._skip(other, f"the world {other.get('name')!r} is left out: the first is taken")
        self._make_names_unique(element)
        world = Scope(element)
        models = [
            made for name, model in world.models.items() for made in self._model(model, world.frame(name))
        ]
        actors = [made for actor in element.findall("actor") for made in self._actor(actor)]
        for light in element.findall("light"):
            self._light(light, world.pose_of(light))
        self._list_the_rest(element)
        for kind, made, most in (("things", models, MOST_THINGS), ("people", actors, MOST_ACTORS)):
            if len(made) > most:
                self._skip(element, f"{len(made) - most} {kind} are left out: {most} are the most")
                del made[most:]
        if not models and not actors:
            found = Problem("nothing of this world was imported", code="BTU005")
            raise UniverseError([found, *self._problems()], self._file)
        document: dict[str, Any] = {
            "format": "bt-studio/universe",
            "version": 1,
            "name": self._title(element),
            "description": f"Imported from {re.split(r'[/]', self._file)[-1]}.",
            "models": models,
            "actors": actors,
            "lights": self._lights[:MOST_LIGHTS],
        }
        text = to_yaml({key: value for key, value in document.items() if value != []})
        parse_universe(text, self._file)
        needed = {made["file"] for made in models if "file" in made}
        files = {
            path: raw for path, raw in self._meshes.files.items() if path in needed or "/meshes/" in path
        }
        return Imported(text, self._problems(), files, len(models) + len(actors))

    def _problems(self) -> list[Problem]:
        notes = [Problem(note, code="BTU006") for note in self._files.notes]
        return sorted([*notes, *self._left_out.values()], key=lambda problem: problem.line)

    def _make_names_unique(self, world: etree._Element) -> None:
        taken: set[str] = set()
        for model in world.findall("model"):
            name, number = model.get("name") or "model", 0
            while (given := f"{name}_{number}" if number else name) in taken:
                number += 1
            taken.add(given)
            model.set("name", given)

    def _list_the_rest(self, world: etree._Element) -> None:
        for child in world:
            if isinstance(child.tag, str) and child.tag not in _WORLD_QUIET:
                self._skip(child, f"<{_tag(child)}> has no counterpart here")
        gravity = world.find("gravity")
        if gravity is not None:
            x, y, z = numbers(world, "gravity", 3, self._file)
            if math.hypot(x, y) > 0.2 or not -10.0 < z < -9.6:
                self._skip(gravity, "<gravity> is that of the Earth here")

    def _model(self, model: Scope, at: Pose) -> Iterator[dict[str, Any]]:
        for scope in model.walk():
            self._drop_loose_joints(scope)
        made = list(self._parts(model, at))
        if not made and not any(True for _ in model.element.iter("geometry")):
            self._skip(model.element, f"the model {model.name!r} has no shape: nothing of it is here")
        yield from made

    def _drop_loose_joints(self, scope: Scope) -> None:
        """Leaves out joints of links that are not there, as after an include that was not found."""
        for name, joint in list(scope.joints.items()):
            try:
                for tag in ("parent", "child"):
                    scope.link_of(text_of(joint, tag), joint)
            except SdfError as error:
                self._skip(joint, f"the joint {name!r} is left out: {error.problem.message}")
                del scope.joints[name]

    def _parts(self, model: Scope, at: Pose) -> Iterator[dict[str, Any]]:
        for scope in model.walk():
            for child in scope.element:
                if isinstance(child.tag, str) and child.tag not in _MODEL_QUIET:
                    self._skip(child, f"<{_tag(child)}> of the model {scope.name!r} is not simulated")
        links, joints = links_of(model), joints_of(model)
        is_static = any(is_true(scope.element, "static") for scope in model.walk())
        for group in _groups(list(links), joints):
            own = [joint for joint in joints if joint.child in group]
            moving = [joint for joint in own if _moves(joint)]
            is_held = is_static or any(joint.parent == "world" for joint in own)
            if is_static or (is_held and not moving):
                for name in group:
                    yield from self._still(model, *links[name], name, at)
            elif len(group) == 1 and not is_held:
                yield from self._loose(model, *links[group[0]], group[0], at)
            else:
                yield from self._assembly(model, group, at, is_held=is_held)
        for scope, link in links.values():
            for light in link.findall("light"):
                self._light(light, self._in_world(scope, link, light, at))

    @staticmethod
    def _in_world(scope: Scope, link: etree._Element, part: etree._Element, at: Pose) -> Pose:
        return compose(at, compose(scope.in_top(), scope.pose_of(part, link.get("name", ""))))

    def _still(
        self, model: Scope, scope: Scope, link: etree._Element, name: str, at: Pose
    ) -> Iterator[dict[str, Any]]:
        """Yields what never moves: a thing for each shape, or one if it is touched as it is not seen."""
        self._list_link(link, name)
        parts = parts_of(scope, link, at)
        if parts.are_simple:
            for part in parts.seen:
                yield from self._thing(model, link, part, mass=0.0, solid=part.is_touched)
        elif parts.seen or parts.touched:
            yield from self._assembly(model, [name], at, is_held=True)

    def _loose(
        self, model: Scope, scope: Scope, link: etree._Element, name: str, at: Pose
    ) -> Iterator[dict[str, Any]]:
        """Yields a link without joints that can move."""
        parts = parts_of(scope, link, at)
        if not parts.touched:
            self._list_link(link, name)
            if parts.seen:
                self._skip(link, f"the link {name!r} cannot be touched: it does not move here")
            for part in parts.seen:
                yield from self._thing(model, link, part, mass=0.0, solid=False)
        elif len(parts.seen) == 1 and parts.are_simple and parts.is_centred and parts.seen[0].tag != "plane":
            self._list_link(link, name)
            yield from self._thing(model, link, parts.seen[0], mass=parts.mass, solid=True)
        else:
            yield from self._assembly(model, [name], at, is_held=False)

    def _assembly(
        self, model: Scope, group: list[str], at: Pose, *, is_held: bool
    ) -> Iterator[dict[str, Any]]:
        """Yields links as one thing with its own URDF."""
        is_fixed = is_held and not any(_moves(joint) for joint in joints_of(model) if joint.child in group)
        writer = SdfUrdf(model, self._urdf_mesh, self._skip_of_model, group, is_fixed=is_fixed)
        urdf = writer.made()
        if b"<visual" not in urdf and b"<collision" not in urdf:
            return
        words = (model.name,) if group[0] == next(iter(links_of(model))) else (model.name, group[0])
        id_ = self._id(*words)
        path = f"{self._folder}/{id_}.urdf"
        made: dict[str, Any] = {"id": id_, "shape": "urdf", "file": path, "pose": rounded(to_xyz_rpy(at))}
        if not is_held:
            made["mass"] = _bounded(writer.mass(), 1e-3, 1e5)
        if self._accepts(Model, made, model.element):
            self._meshes.files[path] = urdf
            yield made

    def _urdf_mesh(self, shape: etree._Element) -> tuple[str, list[float]] | None:
        found = self._meshes.add(shape)
        return None if found is None else (found[0].removeprefix(f"{self._folder}/"), found[1])

    def _skip_of_model(self, element: etree._Element, message: str) -> None:
        above = element.getparent()
        if above is None or above.tag != "model" or element.tag in ("joint", "link"):
            self._skip(element, message)  # the rest of a model was listed before

    def _thing(
        self, model: Scope, link: etree._Element, part: Part, *, mass: float, solid: bool
    ) -> Iterator[dict[str, Any]]:
        if part.is_ground:  # every universe has one
            return
        shape: dict[str, Any] = {"shape": part.tag, "size": rounded(part.size)}
        if part.tag == "mesh":
            found = self._meshes.add(part.shape)
            if found is None:
                return
            shape = {"shape": "mesh", "file": found[0], "size": rounded(found[1])}
        elif part.tag == "heightmap":
            made_mesh = heightmap_mesh(part.shape, self._files, self._skip)
            if made_mesh is None:
                return
            path = self._meshes.write(f"{model.name}_heightmap", *made_mesh)
            shape = {"shape": "mesh", "file": path}
        made = {
            "id": self._id(model.name, link.get("name", ""), part.element.get("name", "")),
            **shape,
            "pose": rounded(to_xyz_rpy(part.pose)),
            "color": color_of(part.element, self._skip),
        }
        if mass > 0:
            made["mass"] = _bounded(mass, 1e-3, 1e5)
        if not solid:
            made["solid"] = False
        elif part.friction is not None:
            made["friction"] = _bounded(part.friction, 0.0, 10.0)
        if self._accepts(Model, made, part.element):
            yield made

    def _list_link(self, link: etree._Element, name: str) -> None:
        for child in link:
            if child.tag in (
                "sensor",
                "particle_emitter",
                "projector",
                "battery",
                "audio_source",
                "audio_sink",
            ):
                self._skip(child, f"<{child.tag}> of the link {name!r} is not simulated")
        if not is_true(link, "gravity", default=True):
            self._skip(link, f"the link {name!r} has no gravity there, but has it here")

    def _actor(self, actor: etree._Element) -> Iterator[dict[str, Any]]:
        for child in actor:
            if isinstance(child.tag, str) and child.tag not in _ACTOR_QUIET:
                self._skip(child, f"<{_tag(child)}> of the actor {actor.get('name')!r} is not simulated")
        points = []
        for waypoint in actor.iterfind("script/trajectory/waypoint"):
            pose = pose_in(waypoint.find("pose"), self._file)
            points.append((numbers(waypoint, "time", 1, self._file)[0], pose[0], pose[1]))
        if len(points) < 2:
            self._skip(actor, f"the actor {actor.get('name')!r} has no waypoints")
            return
        points.sort(key=lambda point: point[0])
        way = sum(math.dist(a[1:], b[1:]) for a, b in itertools.pairwise(points))
        took = max(points[-1][0] - points[0][0], 1e-3)
        closes = math.dist(points[0][1:], points[-1][1:]) < 0.3
        path = [rounded(point[1:]) for point in (points[:-1] if closes else points)]
        if len(path) > min(1000, self._points):
            self._skip(
                actor, f"the actor {actor.get('name')!r} has too many waypoints: the last are left out"
            )
            path = path[: max(min(1000, self._points), 1)]
        self._points = max(self._points - len(path), 1)
        speed = round(min(way / took, 5.0), 3)
        script = actor.find("script")
        loops = script is None or is_true(script, "loop", default=True)
        made = {"id": self._id(actor.get("name", "")), "model": "person", "path": path, "speed": speed}
        made["loop"] = closes and loops
        if self._accepts(Actor, made, actor):
            yield made

    def _light(self, light: etree._Element, pose: Pose) -> None:
        name = light.get("name")
        if light.get("type", "point") != "directional":
            self._skip(light, f"the light {name!r} is not sunlight")
            return
        direction = rotate(pose[3:], numbers(light, "direction", 3, self._file))
        made = {"direction": rounded(direction), "intensity": 1.0}
        intensity = numbers(light, "intensity", 1, self._file)[0]
        made["intensity"] = _bounded(intensity, 0.0, 10.0)
        if len(self._lights) >= MOST_LIGHTS:
            self._skip(light, f"the light {name!r} is left out: {MOST_LIGHTS} are the most")
        elif self._accepts(Light, made, light):
            self._lights.append(made)

    def _accepts(self, kind: type[Any], made: dict[str, Any], element: etree._Element) -> bool:
        """Returns whether the universe's own rules accept a thing; lists it if they do not."""
        try:
            kind.model_validate(made)
        except ValidationError as error:
            reason = error.errors(include_url=False)[0]
            where = ".".join(map(str, reason["loc"]))
            message = reason["msg"].removeprefix("Value error, ")
            self._skip(element, f"{made.get('id', 'the light')!r} is left out: {where} {message}".strip())
            return False
        return True

    def _id(self, *names: str) -> str:
        words = [re.sub(r"[^A-Za-z0-9_]+", "_", name) for name in names]
        words = words[:1] + [word for word in words[1:] if word not in ("link", "visual", "", *words[:1])]
        stem = "_".join(words)[:70]
        stem = stem if re.match(r"[A-Za-z_]", stem) else f"m_{stem}"
        name, number = stem, 1
        while name in self._ids:
            number += 1
            name = f"{stem}_{number}"
        self._ids.add(name)
        return name

    def _skip(self, element: etree._Element, message: str) -> None:
        problem = problem_at(element, message)
        self._left_out.setdefault((problem.line, problem.message), problem)


def _groups(links: list[str], joints: list[Joint]) -> list[list[str]]:
    """Returns the links that joints hold together, in their order."""
    group = {link: link for link in links}
    for joint in joints:
        if joint.parent in group and joint.child in group:
            old, new = group[joint.child], group[joint.parent]
            group = {link: new if held == old else held for link, held in group.items()}
    found: dict[str, list[str]] = {}
    for link, first in group.items():
        found.setdefault(first, []).append(link)
    return list(found.values())


def _moves(joint: Joint) -> bool:
    return joint.kind not in ("", "fixed") and joint.element.find("axis") is not None


def _bounded(value: float, low: float, high: float) -> float:
    return round(min(max(value, low), high), 6)


def _tag(element: etree._Element) -> str:
    tag = str(element.tag)
    return tag if not tag.startswith("{urn:") else tag[5:].replace("}", ":")


def to_yaml(document: dict[str, Any]) -> str:
    """Returns a universe's document with one thing a line."""
    lines = [
        yaml.dump({key: value}, Dumper=CoreDumper, sort_keys=False, allow_unicode=True, width=1000).rstrip()
        if not isinstance(value, list)
        else f"{key}:\n" + "\n".join(f"  - {_flow(item)}" for item in value)
        for key, value in document.items()
    ]
    return "\n".join(lines) + "\n"


def _flow(item: dict[str, Any]) -> str:
    text: str = yaml.dump(item, Dumper=CoreDumper, sort_keys=False, default_flow_style=True, width=100_000)
    return text.strip()
