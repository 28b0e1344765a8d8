"""Reads COLLADA files for their triangles: materials never matter, the unit does."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from lxml import etree

from executor.world.geometry.pictures import mean_color

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from executor.world.geometry.mesh_colors import Rgba

_MATERIALS: Final = ("library_materials", "library_effects", "library_images", "bind_material")


class Part(NamedTuple):
    """Triangles: points, faces as rows of indices, and texture coordinates (no columns if there are none).

    `colors` are those of the faces; there are none at all if the file has none that can be read.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    uvs: NDArray[np.float64]
    names: tuple[str, ...] = ()
    colors: Sequence[Rgba | None] = ()


def load_collada(data: bytes, read: Callable[[str], bytes | None] = lambda _: None) -> list[Part]:
    """Returns the parts of a file's scene, with lengths in m.

    Axes stay as they are in the file, as RViz leaves them. A picture has its mean colour.

    Args:
        data: the file.
        read: returns a picture that it names; None if there is none.

    Raises:
        Exception: it has no scene that can be read; the reader may raise anything.
    """
    unit = unit_of(data)
    try:
        scene, is_whole = _scene(data)
    except Exception:  # a malformed material may raise anything
        scene, is_whole = None, False
    if not is_whole:
        scene, _ = _scene(_without_materials(data))
    return [part._replace(vertices=part.vertices * unit) for part in _parts(scene, read)]


def _scene(data: bytes) -> tuple[Any, bool]:
    """Returns a file's scene, and whether nothing in it was skipped."""
    import collada  # noqa: PLC0415 - slow to load, and few robots have meshes

    read = collada.Collada(io.BytesIO(data), ignore=[collada.common.DaeError])
    return read.scene, not read.errors


def _parts(scene: Any, read: Callable[[str], bytes | None]) -> Iterator[Part]:
    import collada  # noqa: PLC0415 - as above

    means: dict[str, tuple[float, float, float] | None] = {}

    def mean(name: str) -> tuple[float, float, float] | None:
        if name not in means:
            data = read(name)
            means[name] = None if data is None else mean_color(data)
        return means[name]

    for bound in scene.objects("geometry") if scene is not None else ():
        matrix = np.asarray(bound.matrix, np.float64)
        for primitive in bound.original.primitives:
            found: Any = primitive
            if isinstance(found, collada.polylist.Polylist):
                found = found.triangleset()
            if not isinstance(found, collada.triangleset.TriangleSet) or found.vertex is None:
                continue
            points = np.asarray(found.vertex, np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
            faces = np.asarray(found.vertex_index, np.int64).reshape(-1, 3)
            uvs = np.zeros((len(points), 0))
            if len(found.texcoordset):
                uvs = np.asarray(found.texcoordset[0], np.float64)[found.texcoord_indexset[0].ravel(), :2]
                points, faces = points[faces.ravel()], np.arange(faces.size).reshape(-1, 3)
            if np.linalg.det(matrix[:3, :3]) < 0:  # a reflection inverts triangles
                faces = faces[:, ::-1]
            names = (str(bound.original.name), str(bound.original.id))
            yield Part(points, faces, uvs, names, [_color(bound, found.material, mean)] * len(faces))


def _color(bound: Any, symbol: str, mean: Callable[[str], tuple[float, float, float] | None]) -> Rgba | None:
    """Returns the colour of a material, or None."""
    node = bound.materialnodebysymbol.get(symbol)
    diffuse = None if node is None else getattr(node.target.effect, "diffuse", None)
    image = getattr(getattr(getattr(diffuse, "sampler", None), "surface", None), "image", None)
    if image is not None:
        found = mean(str(image.path))
        return None if found is None else (*found, 1.0)
    if not isinstance(diffuse, tuple) or len(diffuse) != 4:
        return None
    red, green, blue, _ = (min(max(float(value), 0.0), 1.0) for value in diffuse)
    return (red, green, blue, 1.0) if math.isfinite(red + green + blue) else None


def unit_of(data: bytes) -> float:
    """Returns the length in m of the file's unit: 1 if it says none that is one."""
    try:
        found = _parsed(data).find("{*}asset/{*}unit")
        unit = float(found.get("meter", "1")) if found is not None else 1.0
    except (etree.XMLSyntaxError, ValueError):
        return 1.0
    return unit if math.isfinite(unit) and unit > 0 else 1.0


def _without_materials(data: bytes) -> bytes:
    root = _parsed(data)
    for tag in _MATERIALS:
        for element in list(root.iter(f"{{*}}{tag}")):
            parent = element.getparent()
            if parent is not None:
                parent.remove(element)
    return etree.tostring(root)


def _parsed(data: bytes) -> etree._Element:
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=True)
    return etree.fromstring(data, parser)
