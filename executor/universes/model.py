"""The model of a universe document. SI units; poses are [x, y, z, roll, pitch, yaw] in the world frame."""

from __future__ import annotations

import re
from typing import Annotated, Any, Final, Literal, Self

from pydantic import Field, StringConstraints, field_validator, model_validator

from executor.universes.strict import Strict

Shape = Literal["box", "cylinder", "sphere", "plane", "mesh", "urdf", "sdf"]
Name = Annotated[str, StringConstraints(pattern=r"^[A-Za-z_][A-Za-z0-9_-]*$", max_length=80)]
Color = Annotated[str, StringConstraints(pattern=r"^#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?$")]
Texture = Annotated[str, StringConstraints(max_length=300)]
Finite = Annotated[float, Field(allow_inf_nan=False, ge=-1e4, le=1e4)]
Positive = Annotated[float, Field(allow_inf_nan=False, gt=0, le=1e4)]
Pose = tuple[Finite, Finite, Finite, Finite, Finite, Finite]
Point = tuple[Finite, Finite, Finite]

SIZE_MEANING: Final[dict[str, tuple[str, ...]]] = {
    "box": ("x", "y", "z"),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
    "plane": ("x", "y"),
    "mesh": ("scale x", "scale y", "scale z"),
}
FILES: Final[dict[str, tuple[str, ...]]] = {
    "mesh": (".stl", ".obj", ".dae", ".ply", ".glb", ".gltf"),
    "urdf": (".urdf", ".xacro"),
    "sdf": (".sdf",),
}
"""Permitted suffixes of a model's file, for each shape that has a file."""
TEXTURES: Final = ("asphalt", "brick", "carpet", "checker", "grass", "tiles", "wood")
"""Names of the built-in textures."""
SMALLEST_AREA_M2: Final = 1e-6
PICTURES: Final = (".png", ".jpg", ".jpeg")
_AXES: Final = ("x", "y", "z", "roll", "pitch", "yaw")
_RANDOM_KEY: Final = re.compile(
    rf"^(?P<id>[\w-]+)\.(?:pose\.(?P<axis>{'|'.join(_AXES)})|(?P<field>mass|friction|speed))$"
)


class _Painted(Strict):
    """An object with a colour, and optionally a repeated texture.

    `texture` is a built-in texture (`TEXTURES`), or a PNG or JPEG file of the project; `tile` is the width
    and height of one repetition in m. The colour tints the texture; with a texture its default is white.
    """

    color: Color = "#ffffff"
    texture: Texture = ""
    tile: tuple[Positive, Positive] | None = None

    @model_validator(mode="before")
    @classmethod
    def _pictures_keep_their_colors(cls, value: Any) -> Any:
        if isinstance(value, dict) and value.get("texture") and "color" not in value:
            return {**value, "color": "#ffffff"}
        return value

    @field_validator("texture")
    @classmethod
    def _is_a_texture(cls, value: str) -> str:
        if value and value not in TEXTURES and not value.lower().endswith(PICTURES):
            raise ValueError(
                f"a `texture` is {', '.join(TEXTURES)}, or a file that ends in {' or '.join(PICTURES)}"
            )
        return value

    @model_validator(mode="after")
    def _tile_needs_texture(self) -> Self:
        if self.tile is not None and not self.texture:
            raise ValueError("a `tile` needs a `texture`")
        return self


class Ground(_Painted):
    """The infinite floor at z = 0."""

    color: Color = "#d8d4cc"
    friction: float = Field(default=0.9, ge=0, le=10)


class Ceiling(_Painted):
    """The ceiling indoors, `height` m above the floor, over all walls that reach it.

    Robots' cameras see it; views of the world do not, and it casts no shadow. It is visual only: rays and
    bodies pass through it.
    """

    height: float = Field(default=2.5, gt=0, le=1000, allow_inf_nan=False)
    color: Color = "#e8e6e0"


class Model(_Painted):
    """An object of the world; without mass it never moves.

    `size` is in m; `SIZE_MEANING` explains its values.

    A mesh is read from `file`, a path in the project; its `size` is a scale. The collision shape of a mesh is
    the mesh itself without mass, and its convex hull with mass. A model without `solid` is visual only
    (paint, a carpet, a line on the floor): robots and rays pass through it.

    A `urdf` or `sdf` is read from `file` and has several links, with their own sizes and colours; its joints
    move freely. Without `mass` its root link is fixed; otherwise `mass` is its total mass.

    For robots' cameras, a wall with `to_ceiling` reaches the universe's ceiling. Views of the world show the
    wall's own height, so that rooms can be seen; rays and bodies meet that height too.
    """

    id: Name
    shape: Shape
    size: tuple[Positive, ...] = ()
    file: str = Field(default="", max_length=300)
    pose: Pose = (0, 0, 0, 0, 0, 0)
    color: Color = "#9aa4b0"
    mass: float = Field(default=0.0, ge=0, le=1e5)
    friction: float = Field(default=0.6, ge=0, le=10)
    restitution: float = Field(default=0.0, ge=0, le=1)
    solid: bool = True
    to_ceiling: bool = False

    @property
    def is_assembly(self) -> bool:
        """Whether the model is made of links and joints."""
        return self.shape in ("urdf", "sdf")

    @model_validator(mode="after")
    def _file_fits_shape(self) -> Model:
        wanted = FILES.get(self.shape)
        if wanted is None:
            if self.file:
                raise ValueError(f"a {self.shape} has no `file`; {', '.join(FILES)} have one")
        elif not self.file:
            raise ValueError(f"a {self.shape} needs a `file` of the project, such as assets/crate{wanted[0]}")
        elif not self.file.lower().endswith(wanted):
            raise ValueError(f"the `file` of a {self.shape} ends in {' or '.join(wanted)}")
        return self

    @model_validator(mode="after")
    def _size_fits_shape(self) -> Model:
        if self.is_assembly:
            if self.texture:
                raise ValueError(f"a {self.shape} has colours of its own; `texture` cannot be set")
            if self.size:
                raise ValueError(f"a {self.shape} has sizes of its own, and no `size` here")
        elif self.size or self.shape != "mesh":
            meaning = SIZE_MEANING[self.shape]
            if len(self.size) != len(meaning):
                raise ValueError(f"the `size` of a {self.shape} is [{', '.join(meaning)}]")
        return self

    @model_validator(mode="after")
    def _can_reach_the_ceiling(self) -> Model:
        if self.to_ceiling and (self.shape != "box" or self.mass > 0 or any(self.pose[3:5])):
            raise ValueError("only a box without mass that stands upright goes `to_ceiling`")
        return self

    @model_validator(mode="after")
    def _can_weigh(self) -> Model:
        if self.shape == "plane" and self.mass > 0:
            raise ValueError("a plane has no mass")
        if not self.solid and self.mass > 0:
            raise ValueError("what is not solid has no mass: it would fall through the floor")
        return self


class Actor(Strict):
    """A person who walks along `path`, unaffected by collisions; robots can bump into them.

    One who `yields` stops before a robot in the way, and walks on when it has gone.
    """

    id: Name
    model: Literal["person"] = "person"
    color: Color = "#20c020"
    path: tuple[tuple[Finite, Finite], ...] = Field(min_length=1, max_length=1000)
    speed: float = Field(default=0.5, ge=0, le=5)
    loop: bool = True
    start_m: float = Field(default=0.0, ge=0, le=1e4)
    yields: bool = False


class RobotPlace(Strict):
    """A robot and its initial pose; `topics` renames the topics of its sensors.

    With `ground_truth` the robot publishes its true pose on `/ground_truth/odom`.
    """

    id: Name = "robot"
    model: Name = "turtle2"
    pose: Pose = (0, 0, 0, 0, 0, 0)
    topics: dict[str, Annotated[str, StringConstraints(pattern=r"^/[A-Za-z0-9_/]+$")]] = Field(
        default_factory=dict
    )
    ground_truth: bool = False


class Light(Strict):
    """Sunlight, with the direction of its rays."""

    direction: tuple[Finite, Finite, Finite] = (0.3, 0.4, -0.8)
    intensity: float = Field(default=1.0, ge=0, le=10)

    @field_validator("direction")
    @classmethod
    def _not_zero(cls, value: tuple[float, float, float]) -> tuple[float, float, float]:
        if not any(value):
            raise ValueError("a light needs a direction other than [0, 0, 0]")
        return value


class Area(Strict):
    """A named region of the floor: a `box` [x min, y min, x max, y max], or a `polygon` of corners, in m."""

    box: tuple[Finite, Finite, Finite, Finite] | None = None
    polygon: tuple[tuple[Finite, Finite], ...] | None = Field(default=None, min_length=3, max_length=200)

    @model_validator(mode="after")
    def _has_one_shape(self) -> Self:
        if (self.box is None) == (self.polygon is None):
            raise ValueError("an area has either a `box` or a `polygon`")
        if self.box is not None and not (self.box[0] < self.box[2] and self.box[1] < self.box[3]):
            raise ValueError(
                "the `box` of an area is [x min, y min, x max, y max], each min less than its max"
            )
        if abs(self._signed_m2()) < SMALLEST_AREA_M2:
            raise ValueError("the corners of the `polygon` lie on a line")
        return self

    @property
    def corners(self) -> tuple[tuple[float, float], ...]:
        """The corners in order, of a box too."""
        if self.box is not None:
            x0, y0, x1, y1 = self.box
            return (x0, y0), (x1, y0), (x1, y1), (x0, y1)
        return self.polygon or ()

    def _signed_m2(self) -> float:
        corners = self.corners
        pairs = zip(corners, corners[1:] + corners[:1], strict=True)
        return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs) / 2


class View(Strict):
    """Initial view of the world: eye and target in m."""

    eye: Point = (-4.5, -5.0, 4.5)
    target: Point = (0.0, 0.0, 0.2)


class Universe(Strict):
    """A universe: ground, ceiling, models, people, robots, light, and named areas of the floor."""

    format: Literal["bt-studio/universe"]
    version: Literal[1]
    name: str = Field(min_length=1, max_length=120)
    description: str = ""
    ground: Ground = Ground()
    ceiling: Ceiling | None = None
    models: tuple[Model, ...] = Field(default=(), max_length=2000)
    actors: tuple[Actor, ...] = Field(default=(), max_length=100)
    robots: tuple[RobotPlace, ...] = Field(default=(RobotPlace(),), max_length=10)
    lights: tuple[Light, ...] = Field(default=(Light(),), min_length=1, max_length=4)
    view: View = View()
    areas: dict[Name, Area] = Field(default_factory=dict, max_length=200)
    random: dict[str, tuple[Finite, Finite]] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _ids_are_unique(self) -> Universe:
        taken = {"ground"} if self.ceiling is None else {"ground", "ceiling"}
        seen = set(taken)
        for thing in self._things():
            if thing.id in seen:
                how = "taken" if thing.id in taken else "used twice"
                raise ValueError(f"the id {thing.id!r} is {how}")
            seen.add(thing.id)
        return self

    @model_validator(mode="after")
    def _random_keys_exist(self) -> Universe:
        things = {thing.id: thing for thing in self._things()}
        for key, (low, high) in self.random.items():
            match = _RANDOM_KEY.match(key)
            if match is None or match["id"] not in things:
                raise ValueError(f"random: {key!r} matches no value; use <id>.pose.x, <id>.mass or the like")
            wanted = "pose" if match["axis"] else match["field"]
            if wanted not in type(things[match["id"]]).model_fields:
                raise ValueError(f"random: {match['id']!r} has no {wanted}")
            if low > high:
                raise ValueError(f"random: the range of {key!r} must start with its lower bound")
        return self

    def _things(self) -> list[Model | Actor | RobotPlace]:
        return [*self.models, *self.actors, *self.robots]

    def random_target(self, key: str) -> tuple[str, str, int]:
        """Returns (id, field, index into the field or -1) for a key of `random`."""
        match = _RANDOM_KEY.match(key)
        if match is None:
            raise KeyError(key)
        if match["axis"]:
            return match["id"], "pose", _AXES.index(match["axis"])
        return match["id"], match["field"], -1
