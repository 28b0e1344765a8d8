"""Shows meshes in the colours of their files: a visual becomes one for each colour."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from executor.messages import Mesh
    from executor.robots.urdf import Link, Urdf, Visual
    from executor.world.geometry.mesh import ColoredMesh


def with_colors(urdf: Urdf, meshes: dict[str, Mesh], painted: Mapping[str, ColoredMesh]) -> Urdf:
    """Returns a robot whose visuals without their own colour have those of their mesh.

    The meshes of single colours are added to `meshes`; one that is only seen is no longer needed as a whole.
    """
    links = {name: _link(link, painted, meshes) for name, link in urdf.links.items()}
    needed = {visual.file for link in links.values() for visual in link.visuals} | set(urdf.touched_meshes)
    for name in painted:
        if name not in needed:
            del meshes[name]
    return replace(urdf, links=links)


def _link(link: Link, painted: Mapping[str, ColoredMesh], meshes: dict[str, Mesh]) -> Link:
    return replace(link, visuals=tuple(v for visual in link.visuals for v in _of(visual, painted, meshes)))


def _of(visual: Visual, painted: Mapping[str, ColoredMesh], meshes: dict[str, Mesh]) -> Iterator[Visual]:
    found = painted.get(visual.file)
    if not visual.is_plain or found is None or not found.parts:
        yield visual
        return
    for number, (color, mesh) in enumerate(found.parts):
        file = f"{visual.file}#{number}"
        meshes[file] = mesh
        yield replace(visual, file=file, color=color or visual.color)
