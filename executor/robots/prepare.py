"""Makes the URDF for the physics engine: converts meshes, merges fixed links, gives every link a mass.

Axes get length 1, and damping that the engine's steps can carry.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from lxml import etree

from executor.robots.rigid import merge_fixed_links
from executor.robots.stable import settle_joints
from executor.supervision.scratch import Scratch
from executor.world.geometry.mesh import MeshError, write_obj
from tree_gardener.packages import MissingPackageError, PackageError, Packages, Place

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator
    from pathlib import Path

    from executor.messages import Mesh

_FEATHER: Final = (
    '<inertial><mass value="0.001"/>'
    '<inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/></inertial>'
)


def mesh_path(name: str, folder: Path, packages: Packages | None = None) -> Path:
    """Returns the path of a mesh that a URDF names: relative, `file://`, `package://` or `model://`.

    A package that nobody has is taken for the robot's own folder or one beside it, if that has the file.

    Args:
        name: the name of the mesh in the URDF.
        folder: the folder of the URDF.
        packages: where packages are searched; in that folder if it is None.

    Raises:
        MeshError: it is outside of the places that are searched.
    """
    if packages is None:
        packages = Packages(folder, [Place("the robot's folder", folder)])
    bases = [folder, *(place.folder for place in packages.places)]
    try:
        path = packages.file(name)
        candidates = [path] if "://" in name else [path, *(base / name for base in bases)]
    except MissingPackageError as error:
        package, _, rest = name.split("://", 1)[1].partition("/")
        candidates = [base / below for base in bases for below in (rest, f"{package}/{rest}")]
        candidates = [path for path in candidates if path.is_file()]
        if not candidates:
            raise MeshError(f"there is no file {name.rsplit('/', 1)[-1]}: {error}") from error
    except PackageError as error:
        raise MeshError(str(error)) from error
    inside = [path for path in candidates if packages.may_read(path)]
    if not inside:
        raise MeshError(f"{name} lies outside the robot's folder")
    return next((path for path in inside if path.is_file()), inside[0])


@contextmanager
def physical_urdf(text: str, meshes: dict[str, Mesh], apart: Collection[str] = ()) -> Iterator[Path]:
    """Yields a temporary file that the physics engine loads.

    Args:
        text: the URDF, valid.
        meshes: the meshes by their names in the URDF.
        apart: links that must not be merged with the links that they are fixed to.
    """
    root = etree.fromstring(text.encode(), etree.XMLParser(resolve_entities=False, no_network=True))
    # A manager that makes room on a full disk spares this folder, since its lock is held.
    scratch = Scratch()
    try:
        yield _write(scratch.path, root, meshes, apart)
    finally:
        scratch.remove()


def _write(folder: Path, root: etree._Element, meshes: dict[str, Mesh], apart: Collection[str]) -> Path:
    files: dict[str, Path] = {}
    merge_fixed_links(root, apart)
    for link in root.findall("link"):
        for visual in link.findall("visual"):  # visuals are for our renderer, not for Bullet
            link.remove(visual)
        for inertial in link.findall("inertial"):
            masses = inertial.findall("mass")
            # Bullet takes a root without mass for a part of the world.
            if any(float(mass.get("value", "")) == 0 for mass in masses):
                link.remove(inertial)
        if link.find("inertial") is None:
            link.insert(0, etree.fromstring(_FEATHER))
        for element in link.iterfind("collision/geometry/mesh"):
            name = element.get("filename", "")
            if name not in files:
                files[name] = folder / f"mesh_{len(files)}.obj"
                write_obj(meshes[name], files[name])
            element.set("filename", str(files[name]))
    settle_joints(root)
    path = folder / "robot.urdf"
    path.write_bytes(etree.tostring(root))
    return path
