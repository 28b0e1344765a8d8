"""The MessagePack frames of the stream socket, each with its name in ``type``.

They are a part of the protocol in `executor.messages`.

Units are SI, frames follow REP-103, times are simulated seconds.
"""

from __future__ import annotations

from typing import Final, Literal

from msgspec import Struct


class Shape(Struct, omit_defaults=True):
    """A visual shape in its object's frame.

    Args:
        shape: the kind of shape; its `size` in m is [x, y, z] for a box, [radius, length] for a cylinder or a
            capsule along z, [radius] for a sphere, [x, y] for a plane, [sx, sy, sz] (scale) for a mesh.
        pose: [x, y, z, qx, qy, qz, qw] in the object's frame.
        color: [r, g, b, a], each 0 to 1, sRGB.
        mesh: key in `Scene.meshes` for a mesh, else "".
        texture: key in `Scene.textures`, or "" for none; the colour tints it.
        ceiling: whether the shape is a ceiling or the upper part of a wall, which only robots' cameras see.
    """

    shape: Literal["box", "cylinder", "sphere", "capsule", "plane", "mesh"]
    size: list[float]
    pose: list[float]
    color: list[float]
    mesh: str = ""
    texture: str = ""
    ceiling: bool = False


class SceneObject(Struct):
    """One rigid object: a body, or a link of a robot; `pose` is [x, y, z, qx, qy, qz, qw]."""

    id: int
    body: str
    link: str
    kind: Literal["static", "dynamic", "robot", "actor"]
    shapes: list[Shape]
    pose: list[float]


class Mesh(Struct, omit_defaults=True):
    """The triangles of a mesh.

    Positions and normals are little-endian float32 (3 for each vertex), indices are uint32.

    `uvs` are the texture coordinates of the file, if it has any: two float32 for each vertex; v points up.
    """

    positions: bytes
    normals: bytes
    indices: bytes
    uvs: bytes = b""


class Texture(Struct):
    """An image that is repeated: a JPEG file, and the width and height of one repetition in m.

    `executor/render/mapping.py` maps it to shapes; a mesh with `uvs` uses these coordinates, and the size is
    not used.
    """

    jpeg: bytes
    tile: list[float]


class Light(Struct):
    """A directional light, with the direction of its rays."""

    direction: list[float]
    intensity: float


class SensorPlacement(Struct):
    """Pose of a sensor in the frame of object `object_id`; `fov` is horizontal, in rad."""

    name: str
    kind: Literal["lidar", "camera"]
    object_id: int
    pose: list[float]
    fov: float
    range: float


class Scene(Struct, tag="scene", tag_field="type", omit_defaults=True):
    """The world, sent once to each client and again when it changes."""

    name: str
    t: float
    objects: list[SceneObject]
    meshes: dict[str, Mesh]
    lights: list[Light]
    ground_color: list[float]
    sensors: list[SensorPlacement]
    textures: dict[str, Texture] = {}
    ground_texture: str = ""


class Poses(Struct, tag="poses", tag_field="type"):
    """The poses that changed: `ids` as little-endian uint16, and in `poses` 16 bytes for each id.

    Of these 16 bytes, bytes 0-8 are x, y, z as int24 in 0.1 mm; byte 9 is the index of the omitted one of qx,
    qy, qz, qw (the largest, made positive); bytes 10-15 are the others as int16 in 1/(32767 * sqrt(2)).
    Little-endian.
    """

    t: float
    ids: bytes
    poses: bytes


class Scan(Struct, tag="scan", tag_field="type"):
    """One LIDAR scan: ranges as float32 in m, counter-clockwise, and the pose of the sensor in the world."""

    t: float
    sensor: str
    pose: list[float]
    angle_min: float
    angle_increment: float
    range_max: float
    ranges: bytes


class Camera(Struct, tag="camera", tag_field="type"):
    """One JPEG image of a robot's camera.

    `sensor` is the name of the sensor; for robots other than the first it is `robot/sensor`.
    """

    t: float
    sensor: str
    width: int
    height: int
    jpeg: bytes


class View(Struct, tag="view", tag_field="type"):
    """One JPEG frame of the stream `view`: the world, drawn by the server."""

    t: float
    width: int
    height: int
    jpeg: bytes


class RecordingPart(Struct, tag="recording", tag_field="type"):
    """A part of a segment of a recording, as `read_recording` asked for it."""

    run: str
    branch: int
    segment: int
    version: int
    offset: int
    data: bytes


FRAMES: Final[tuple[type[Struct], ...]] = (Scene, Poses, Scan, Camera, View, RecordingPart)
