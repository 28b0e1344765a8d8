"""Reads a URDF, xacro or SDF model with all its meshes; errors have a line."""

from __future__ import annotations

import logging
import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from executor.robots.boxes import with_boxes
from executor.robots.expand import source_of
from executor.robots.painting import with_colors
from executor.robots.prepare import mesh_path
from executor.robots.urdf import Urdf, UrdfError, parse_urdf
from executor.universes.document import DocumentError, Problem
from executor.world.geometry.mesh import ColoredMesh, MeshError, load_colored
from tree_gardener.packages import Packages, Place, installed_places

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from executor.expansion.apart import Source
    from executor.messages import Mesh

_log = logging.getLogger(__name__)


def read_links(
    path: Path, where: str, places: Sequence[Place] = (), arguments: Mapping[str, str] | None = None
) -> tuple[Urdf, dict[str, Mesh]]:
    """Returns the links of a file, and their meshes by their names in it.

    A mesh that is only seen and cannot be read becomes a box, with a note.

    Args:
        path: the path of the file.
        where: the name of the file in errors.
        places: where packages and meshes are searched; the file's own folder if there are none.
        arguments: values of the arguments of its macros.

    Raises:
        DocumentError: it cannot be read, or is wrong.
    """
    urdf, meshes, _ = read_source(path, where, places, arguments)
    return urdf, meshes


def read_source(
    path: Path,
    where: str,
    places: Sequence[Place] = (),
    arguments: Mapping[str, str] | None = None,
    *,
    is_lenient: bool = False,
) -> tuple[Urdf, dict[str, Mesh], Source]:
    """Returns what `read_links` does, and the URDF with the place of each of its lines.

    If it is lenient, an include of a package that nobody has is left out, with a note.
    """
    places = places or [Place("the robot's folder", path.parent)]
    packages = Packages(path.parent, places, installed_places(os.environ))
    names = _Names(path, where)
    try:
        source, left_out = source_of(path, packages, arguments, is_lenient=is_lenient)
        urdf = _parsed(source)
    except OSError as error:
        problem = Problem(f"the file cannot be read: {error.strerror or error}", code="BTR002")
        raise DocumentError([problem], where) from error
    except UrdfError as error:
        raise names.error([(Path(error.file), error.line, error.message)], "BTR002") from error
    meshes: dict[str, Mesh] = {}
    painted: dict[str, ColoredMesh] = {}
    broken: dict[str, tuple[Path, int, str]] = {}
    for name, line in urdf.mesh_files.items():
        try:
            painted[name] = load_colored(mesh_path(name, path.parent, packages), packages.may_read)
            meshes[name] = painted[name].whole
        except MeshError as error:
            place = (path, _line_of(name, path)) if path.suffix == ".sdf" else source.place(line)
            broken[name] = (*place, str(error))
    touched = [problem for name, problem in broken.items() if name in urdf.touched_meshes]
    if touched:
        raise names.error(touched, "BTR004")
    urdf = replace(
        urdf, notes=tuple(names.problem(*source.place(n.line), n.message, n.code) for n in urdf.notes)
    )
    if broken:
        problems = {name: names.problem(*problem, "BTR004") for name, problem in broken.items()}
        urdf = with_boxes(urdf, meshes, problems)
    urdf = with_colors(urdf, meshes, painted)
    lost = [
        names.problem(*source.place(line), painted[name].note, "BTR004")
        for name, line in urdf.mesh_files.items()
        if name in painted and painted[name].note and name in _plain_files(urdf)
    ]
    notes = [Problem(note, code="BTR005") for note in dict.fromkeys([*source.notes, *packages.notes])]
    urdf = replace(urdf, notes=(*left_out, *urdf.notes, *lost, *notes))
    for note in urdf.notes:
        _log.warning("%s:%s", where, note)
    return urdf, meshes, source


def _parsed(source: Source) -> Urdf:
    try:
        return parse_urdf(source.text, str(source.file))
    except UrdfError as error:
        file, line = source.place(error.line)
        raise UrdfError(error.message, str(file), line) from error


def _plain_files(urdf: Urdf) -> set[str]:
    return {visual.file for link in urdf.links.values() for visual in link.visuals if visual.is_plain}


class _Names:
    """Names the files of a robot in errors: one that is included lies beside the file, or elsewhere."""

    def __init__(self, path: Path, where: str) -> None:
        self._path = path
        self._where = where

    def error(self, found: list[tuple[Path, int, str]], code: str) -> DocumentError:
        """Returns an error; its file is that of the first problem."""
        file = self._name(found[0][0])
        problems = [
            Problem(
                message if self._name(path) == file else f"{self._name(path)}:{line}: {message}",
                line,
                code=code,
            )
            for path, line, message in found
        ]
        return DocumentError(problems, file)

    def problem(self, path: Path, line: int, message: str, code: str) -> Problem:
        """Returns a problem of the robot's file, whose message names another file if it is there."""
        name = self._name(path)
        if name == self._where:
            return Problem(message, line, code=code)
        return Problem(f"{message} ({name}:{line})", code=code)

    def _name(self, path: Path) -> str:
        if path == self._path:
            return self._where
        folder = os.path.dirname(self._where)  # noqa: PTH120 - a path of the project, as text
        return os.path.normpath(os.path.join(folder, os.path.relpath(path, self._path.parent)))  # noqa: PTH118


def _line_of(mesh: str, path: Path) -> int:
    """Returns the line of an SDF file that names a mesh; a line of the generated URDF would not help."""
    stem = mesh.rsplit("/", 1)[-1]
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    return next((i for i, line in enumerate(lines, 1) if stem in line), 1)
