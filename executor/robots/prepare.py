"""Makes the URDF for the physics engine: converts meshes, merges fixed links, gives every link a mass."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from lxml import etree

from executor.robots.rigid import merge_fixed_links
from executor.supervision.scratch import Scratch
from executor.world.geometry.mesh import MeshError, write_obj

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator
    from pathlib import Path

    from executor.messages import Mesh

_FEATHER: Final = (
    '<inertial><mass value="0.001"/>'
    '<inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/></inertial>'
)


def mesh_path(name: str, folder: Path) -> Path:
    """Returns the path of a mesh that a URDF names: relative to `folder`, or `package://…` in or beside it.

    Raises:
        MeshError: it is outside of the folder.
    """
    if name.startswith("package://"):
        package, _, rest = name.removeprefix("package://").partition("/")
        candidates = [folder / rest, folder / package / rest, folder.parent / package / rest]
        root = folder.parent
    else:
        candidates = [folder / name.removeprefix("file://")]
        root = folder
    inside = [path for path in candidates if path.resolve().is_relative_to(root.resolve())]
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
    files = {}
    for number, (mesh_name, mesh) in enumerate(meshes.items()):
        files[mesh_name] = folder / f"mesh_{number}.obj"
        write_obj(mesh, files[mesh_name])
    merge_fixed_links(root, apart)
    for link in root.findall("link"):
        for visual in link.findall("visual"):  # visuals are for our renderer, not for Bullet
            link.remove(visual)
        if link.find("inertial") is None:
            link.insert(0, etree.fromstring(_FEATHER))
        for element in link.iterfind("collision/geometry/mesh"):
            element.set("filename", str(files[element.get("filename", "")]))
    path = folder / "robot.urdf"
    path.write_bytes(etree.tostring(root))
    return path
