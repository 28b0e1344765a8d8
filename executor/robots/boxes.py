"""A mesh that is only seen and cannot be read becomes a box: it costs the robot its looks, not its drive."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np
from lxml import etree

from executor.robots.urdf import Link, Visual, read_origin, read_shape
from executor.universes.document import Problem
from executor.world.geometry.transforms import IDENTITY, rotation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from executor.messages import Mesh
    from executor.robots.urdf import Urdf

UNKNOWN_M: Final = 0.1
"""Edge in m of the box of a link that has no shape with a size."""


def with_boxes(urdf: Urdf, meshes: Mapping[str, Mesh], broken: Mapping[str, Problem]) -> Urdf:
    """Returns the URDF with a box for each visual mesh that is broken, and a note for each file.

    The box is that of the link's other shapes, seen or touched: what the mesh should have shown.

    Args:
        urdf: the links.
        meshes: the meshes that could be read, by their names.
        broken: why the others could not.
    """
    touched = _collisions(urdf)
    links = {
        name: _with_boxes(link, touched.get(name, ()), meshes, broken) for name, link in urdf.links.items()
    }
    notes = [
        Problem(f"{problem.message}: a box is shown in its place", problem.line, problem.column, problem.code)
        for problem in broken.values()
    ]
    return replace(urdf, links=links, notes=(*urdf.notes, *notes))


def extent_of_links(
    urdf: Urdf, meshes: Mapping[str, Mesh]
) -> dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Returns the lowest and the highest corner of what can be touched of each link, in its frame.

    A link that cannot be touched has those of what is seen of it, if anything is.
    """
    touched = _collisions(urdf)
    found = {}
    for name, link in urdf.links.items():
        shapes = touched.get(name) or link.visuals
        corners = [_corners(s, meshes) for s in shapes if s.shape != "mesh" or s.file in meshes]
        if corners:
            points = np.concatenate(corners)
            found[name] = (points.min(axis=0), points.max(axis=0))
    return found


def _with_boxes(
    link: Link, touched: tuple[Visual, ...], meshes: Mapping[str, Mesh], broken: Mapping[str, Problem]
) -> Link:
    if not any(visual.file in broken for visual in link.visuals):
        return link
    sound = [visual for visual in (*link.visuals, *touched) if visual.file not in broken]
    corners = [_corners(visual, meshes) for visual in sound]
    shown: list[Visual] = []
    is_boxed = False
    for visual in link.visuals:
        if visual.file not in broken:
            shown.append(visual)
        elif not corners:
            shown.append(Visual("box", (UNKNOWN_M,) * 3, visual.pose, visual.color))
        elif not is_boxed:
            is_boxed = True
            points = np.concatenate(corners)
            low, high = points.min(axis=0), points.max(axis=0)
            x, y, z = ((low + high) / 2).tolist()
            size = tuple(np.maximum(high - low, 1e-3).tolist())
            shown.append(Visual("box", size, (x, y, z, *IDENTITY[3:]), visual.color))
    return replace(link, visuals=tuple(shown))


def _collisions(urdf: Urdf) -> dict[str, tuple[Visual, ...]]:
    root = etree.fromstring(urdf.text.encode())
    return {
        link.get("name", ""): tuple(
            Visual(*read_shape(part)[:2], read_origin(part), (0.6, 0.6, 0.6, 1.0), read_shape(part)[2])
            for part in link.findall("collision")
            if part.find("geometry/*") is not None
        )
        for link in root.findall("link")
    }


def _corners(visual: Visual, meshes: Mapping[str, Mesh]) -> NDArray[np.float64]:
    """Returns the corners of the box of a shape, in the frame of its link."""
    low, high = _extent(visual, meshes)
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * (high - low) + low
    turned: NDArray[np.float64] = corners @ rotation(visual.pose[3:]).T + np.array(visual.pose[:3])
    return turned


def _extent(visual: Visual, meshes: Mapping[str, Mesh]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    size = visual.size
    if visual.shape == "mesh":
        points = np.frombuffer(meshes[visual.file].positions, "<f4").reshape(-1, 3) * np.array(size)
        return points.min(axis=0).astype(np.float64), points.max(axis=0).astype(np.float64)
    if visual.shape == "box":
        half = np.array(size) / 2
    elif visual.shape == "sphere":
        half = np.full(3, size[0])
    else:
        caps = size[0] if visual.shape == "capsule" else 0.0
        half = np.array([size[0], size[0], size[1] / 2 + caps])
    return -half, half
