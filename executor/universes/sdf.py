"""Converts an SDF world to a universe, and lists the elements that were left out."""

from __future__ import annotations

import itertools
import math
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

import yaml
from lxml import etree

from executor.universes.document import Problem
from executor.universes.loader import UniverseError, parse_universe
from executor.world.geometry.transforms import Pose, compose, from_xyz_rpy, to_xyz_rpy

if TYPE_CHECKING:
    from collections.abc import Iterator

MAX_BYTES: Final = 20_000_000
LARGE_M: Final = 20.0
_QUIET: Final = frozenset({"pose", "static", "link", "self_collide", "allow_auto_disable", "name", "uri"})
_WORLD_QUIET: Final = frozenset({"model", "light", "actor", "gravity", "magnetic_field", "atmosphere"})
_GREY: Final = "#9aa4b0"


@dataclass
class Imported:
    """A universe's document as YAML, and the elements of the SDF world that were left out."""

    text: str
    left_out: list[Problem] = field(default_factory=list)


def import_sdf(data: bytes, file: str = "world.sdf") -> Imported:
    """Returns the universe of an SDF world.

    Raises:
        UniverseError: the document is not an SDF, or has no supported element.
    """
    reader = _Reader(file)
    document = reader.world(_parse(data, file))
    text = _to_yaml(document)
    parse_universe(text, file)
    return Imported(text, sorted(reader.left_out, key=lambda problem: problem.line))


def _parse(data: bytes, file: str) -> etree._Element:
    if len(data) > MAX_BYTES or b"<!DOCTYPE" in data:
        raise UniverseError(
            [Problem("an SDF world has no DOCTYPE and is smaller than 20 MB", code="BTU005")], file
        )
    try:
        root = etree.fromstring(data, etree.XMLParser(resolve_entities=False, no_network=True))
    except etree.XMLSyntaxError as error:
        raise UniverseError([Problem(str(error.msg), error.lineno or 1, code="BTU005")], file) from error
    world = root.find("world") if root.tag == "sdf" else None
    if world is None:
        raise UniverseError([Problem("there is no <world> in an <sdf> element", code="BTU005")], file)
    return world


class _Reader:
    def __init__(self, file: str) -> None:
        self.left_out: list[Problem] = []
        self._file = file
        self._ids: set[str] = {"ground", "robot"}

    def world(self, world: etree._Element) -> dict[str, Any]:
        document: dict[str, Any] = {
            "format": "bt-studio/universe",
            "version": 1,
            "name": (world.get("name") or "SDF world")[:120],
            "description": f"Imported from {self._file}.",
            "models": [model for element in world.findall("model") for model in self._model(element)],
            "actors": [actor for element in world.findall("actor") for actor in self._actor(element)],
            "lights": [light for element in world.findall("light") for light in self._light(element)][:4],
        }
        for child in world:
            if isinstance(child.tag, str) and child.tag not in _WORLD_QUIET:
                self._skip(child, f"<{child.tag}> has no counterpart here")
        return {key: value for key, value in document.items() if value != []}

    # --- models ---

    def _model(self, model: etree._Element) -> Iterator[dict[str, Any]]:
        base = self._pose(model)
        is_static = _text(model, "static") in ("true", "1")
        links = model.findall("link")
        for child in model:
            if isinstance(child.tag, str) and child.tag not in _QUIET:
                self._skip(child, f"<{child.tag}> of the model {model.get('name')!r} is not simulated")
        parts = sum(len(link.findall("visual")) for link in links)
        moves = not is_static and parts == 1
        if not is_static and parts > 1:
            self._skip(model, f"the model {model.get('name')!r} has several parts: it is static here")
        for link in links:
            at = compose(base, self._pose(link))
            for visual in link.findall("visual"):
                made = self._visual(model, link, visual, at)
                if made is not None:
                    if moves:
                        made["mass"] = _mass(link)
                    yield made
            if not link.findall("visual") and link.findall("collision"):
                self._skip(link, f"the link {link.get('name')!r} can be touched but not seen")

    def _visual(
        self, model: etree._Element, link: etree._Element, visual: etree._Element, at: Pose
    ) -> dict[str, Any] | None:
        geometry = visual.find("geometry")
        shape = geometry[0] if geometry is not None and len(geometry) else None
        found = None if shape is None else self._shape(shape)
        if found is None:
            return None
        pose = to_xyz_rpy(compose(at, self._pose(visual)))
        made = {"id": self._id(model, link, visual), **found, "pose": _rounded(pose), "color": _color(visual)}
        if not link.findall("collision"):
            made["solid"] = False
        return made

    def _shape(self, shape: etree._Element) -> dict[str, Any] | None:
        size: list[float]
        match shape.tag:
            case "box":
                size = self._numbers(shape, "size", 3)
            case "cylinder":
                size = [*self._numbers(shape, "radius", 1), *self._numbers(shape, "length", 1)]
            case "sphere":
                size = self._numbers(shape, "radius", 1)
            case "plane":
                size = self._numbers(shape, "size", 2) if shape.find("size") is not None else [LARGE_M] * 2
                if min(size) >= LARGE_M:  # a ground plane is left out: every universe has one
                    return None
            case "mesh":
                return self._mesh(shape)
            case _:
                self._skip(shape, f"<{shape.tag}> is no shape that we have")
                return None
        return {"shape": str(shape.tag), "size": _rounded(size)}

    def _mesh(self, shape: etree._Element) -> dict[str, Any] | None:
        uri = _text(shape, "uri")
        if "://" in uri and not uri.startswith("file://"):
            self._skip(shape, f"the mesh {uri} is not part of the project; put it into assets/ and name it")
            return None
        scale = self._numbers(shape, "scale", 3) if shape.find("scale") is not None else [1.0, 1.0, 1.0]
        name = uri.removeprefix("file://").lstrip("/")
        path = name if name.startswith("assets/") else f"assets/{name}"
        return {"shape": "mesh", "file": path, "size": _rounded(scale)}

    # --- others ---

    def _actor(self, actor: etree._Element) -> Iterator[dict[str, Any]]:
        points = []
        for waypoint in actor.iterfind("script/trajectory/waypoint"):
            pose = self._pose(waypoint)
            points.append((self._numbers(waypoint, "time", 1)[0], pose[0], pose[1]))
        if len(points) < 2:
            self._skip(actor, f"the actor {actor.get('name')!r} has no waypoints")
            return
        way = sum(math.dist(a[1:], b[1:]) for a, b in itertools.pairwise(points))
        took = max(points[-1][0] - points[0][0], 1e-3)
        closes = math.dist(points[0][1:], points[-1][1:]) < 0.3
        path = [_rounded(point[1:]) for point in (points[:-1] if closes else points)]
        speed = round(min(way / took, 5.0), 3)
        yield {"id": self._id(actor), "model": "person", "path": path, "speed": speed, "loop": closes}

    def _light(self, light: etree._Element) -> Iterator[dict[str, Any]]:
        if light.get("type") != "directional":
            self._skip(light, f"the light {light.get('name')!r} is not sunlight")
            return
        yield {"direction": _rounded(self._numbers(light, "direction", 3)), "intensity": 1.0}

    def _pose(self, element: etree._Element) -> Pose:
        pose = element.find("pose")
        if pose is None or not (pose.text or "").strip():
            return from_xyz_rpy((0, 0, 0, 0, 0, 0))
        if pose.get("relative_to"):
            self._skip(pose, f"a pose relative to {pose.get('relative_to')!r} is taken as the parent's")
        return from_xyz_rpy(self._numbers(element, "pose", 6))

    def _numbers(self, element: etree._Element, tag: str, count: int) -> list[float]:
        text = _text(element, tag)
        try:
            values = [float(word) for word in text.split()]
        except ValueError:
            values = []
        if len(values) != count or not all(map(math.isfinite, values)):
            message = f"<{tag}> needs {count} number{'s' if count > 1 else ''}, not {text!r}"
            found = element.find(tag)
            line = _line(element if found is None else found)
            raise UniverseError([Problem(message, line, code="BTU005")], self._file)
        return values

    def _id(self, *elements: etree._Element) -> str:
        words = [re.sub(r"\W+", "_", element.get("name") or str(element.tag)) for element in elements]
        words = words[:1] + [word for word in words[1:] if word not in ("link", "visual", *words[:1])]
        stem = "_".join(words)[:70]
        stem = stem if re.match(r"[A-Za-z_]", stem) else f"m_{stem}"
        name, number = stem, 1
        while name in self._ids:
            number += 1
            name = f"{stem}_{number}"
        self._ids.add(name)
        return name

    def _skip(self, element: etree._Element, message: str) -> None:
        self.left_out.append(Problem(message, _line(element), code="BTU006"))


def _to_yaml(document: dict[str, Any]) -> str:
    lines = [
        yaml.safe_dump({key: value}, sort_keys=False, allow_unicode=True, width=1000).rstrip()
        if not isinstance(value, list)
        else f"{key}:\n" + "\n".join(f"  - {_flow(item)}" for item in value)
        for key, value in document.items()
    ]
    return "\n".join(lines) + "\n"


def _flow(item: dict[str, Any]) -> str:
    text: str = yaml.safe_dump(item, sort_keys=False, default_flow_style=True, width=100_000)
    return text.strip()


def _rounded(values: Any) -> list[float]:
    return [round(float(value), 6) + 0.0 for value in values]


def _text(element: etree._Element, tag: str) -> str:
    return (element.findtext(tag) or "").strip()


def _line(element: etree._Element) -> int:
    return int(str(element.sourceline))


def _mass(link: etree._Element) -> float:
    try:
        return min(max(float(link.findtext("inertial/mass") or 1.0), 1e-3), 1e5)
    except ValueError:
        return 1.0


def _color(visual: etree._Element) -> str:
    text = visual.findtext("material/diffuse") or visual.findtext("material/ambient") or ""
    try:
        channels = [min(max(float(word), 0.0), 1.0) for word in text.split()][:3]
    except ValueError:
        channels = []
    return (
        "#" + "".join(f"{round(channel * 255):02x}" for channel in channels) if len(channels) == 3 else _GREY
    )
