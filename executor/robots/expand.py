"""Turns xacro and SDF into URDF.

The conversion runs only in processes that load a robot, never in the web server; macros run in a child.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.expansion.apart import ExpandError, Source, expand_apart, has_macros
from executor.robots.sdf_model import urdf_of_sdf
from executor.robots.urdf import UrdfError
from executor.sdf.files import DiskFiles
from tree_gardener.packages import Packages, Place

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from executor.universes.document import Problem


def source_of(
    path: Path,
    packages: Packages,
    arguments: Mapping[str, str] | None = None,
    *,
    is_lenient: bool = False,
) -> tuple[Source, list[Problem]]:
    """Returns the URDF of a file, and what of an SDF model was left out.

    Args:
        path: an `.sdf`, which is converted, a file with macros, which are expanded, or a URDF.
        packages: the packages that it may name.
        arguments: values of the arguments of macros.
        is_lenient: whether to leave out an include of a package that nobody has, with a note.

    Raises:
        UrdfError: the SDF or the macros are wrong; `file` is the path of the file that is.
        OSError: it cannot be read.
    """
    data = path.read_bytes()
    if path.suffix == ".sdf":
        made = urdf_of_sdf(data, str(path), DiskFiles(packages))
        return Source(made.urdf, path), made.left_out
    if not has_macros(path, data):
        return Source(data, path), []
    try:
        return expand_apart(path, packages, arguments, is_lenient=is_lenient), []
    except ExpandError as error:
        raise UrdfError(str(error), str(error.file), error.line) from error


def urdf_of(path: Path) -> bytes:
    """Returns the URDF of a file that names no packages outside of its folder.

    Raises:
        UrdfError: the SDF or the macros are wrong.
        OSError: it cannot be read.
    """
    packages = Packages(path.parent, [Place("the robot's folder", path.parent)])
    return source_of(path, packages)[0].text
