"""Reads a URDF, xacro or SDF model with all its meshes; errors have a line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.robots.expand import urdf_of
from executor.robots.prepare import mesh_path
from executor.robots.urdf import Urdf, UrdfError, parse_urdf
from executor.universes.document import DocumentError, Problem
from executor.world.geometry.mesh import MeshError, load_mesh

if TYPE_CHECKING:
    from pathlib import Path

    from executor.messages import Mesh


def read_links(path: Path, where: str) -> tuple[Urdf, dict[str, Mesh]]:
    """Returns the links of a file, and their meshes by their names in it.

    Args:
        path: the path of the file; meshes are searched in its folder.
        where: the name of the file in errors.

    Raises:
        DocumentError: it cannot be read, or is wrong.
    """
    try:
        urdf = parse_urdf(urdf_of(path), path.name)
    except OSError as error:
        problem = Problem(f"the file cannot be read: {error.strerror or error}", code="BTR002")
        raise DocumentError([problem], where) from error
    except UrdfError as error:
        raise DocumentError([Problem(error.message, error.line, code="BTR002")], where) from error
    meshes, problems = {}, []
    for name, line in urdf.mesh_files.items():
        try:
            meshes[name] = load_mesh(mesh_path(name, path.parent))
        except MeshError as error:
            place = line if path.suffix == ".urdf" else _line_of(name, path)
            problems.append(Problem(str(error), place, code="BTR004"))
    if problems:
        raise DocumentError(problems, where)
    return urdf, meshes


def _line_of(mesh: str, path: Path) -> int:
    """Returns the line of the file that names a mesh; a line of the generated URDF would not help users."""
    stem = mesh.rsplit("/", 1)[-1]
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    return next((i for i, line in enumerate(lines, 1) if stem in line), 1)
