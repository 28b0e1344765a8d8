"""Makes the files of a robot from a URDF, xacro or SDF file: a plain URDF, its meshes, and a `robot.yaml`."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any, Final

import yaml
from lxml import etree

from executor.robots.importing.devices import find_sensors
from executor.robots.importing.report import Report
from executor.robots.importing.wheels import Base, find_base
from executor.robots.links import read_source
from executor.robots.prepare import mesh_path
from executor.robots.sdf_model import LINE
from executor.world.geometry.companions import Companions, bundle, has_room
from executor.world.geometry.mesh import MeshError
from translator.yaml_core import CoreDumper
from tree_gardener.packages import Packages, Place, installed_places

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.robots.urdf import Urdf

MOST_MOTORS: Final = 20
HOLD_NM: Final = 20.0
_QUIET: Final = frozenset({"link", "joint", "material", "gazebo", "transmission", "ros2_control"})


@dataclass
class Made:
    """A robot's files by their names in its folder, its `robot.yaml` as data, and the report."""

    files: dict[str, bytes]
    document: dict[str, Any]
    base: Base
    report: Report

    def written(self, source: str) -> dict[str, bytes]:
        """Returns all files, with `robot.yaml` as it is now."""
        text = yaml.dump(
            self.document,
            Dumper=CoreDumper,
            sort_keys=False,
            allow_unicode=True,
            default_flow_style=None,
            width=110,
        )
        return {**self.files, "robot.yaml": f"# Imported from {source}.\n{text}".encode()}


def folder_name(file: Path) -> str:
    """Returns the name that a robot or a world gets by that of its file."""
    stem = file.name.split(".")[0]
    if stem in ("model", "world"):  # of Gazebo: the folder has the name
        stem = file.parent.name
    return re.sub(r"[^A-Za-z0-9_-]", "_", stem)[:60] or "imported"


def places_of(file: Path, source: Path, workspace: Path | None) -> list[Place]:
    """Returns where packages are searched: the file's own package, then what is imported."""
    package = next((up for up in file.parents if (up / "package.xml").is_file()), file.parent)
    if source.is_dir():
        around = source
    else:
        around = next((up for up in file.parents if (up / ".git").exists() or up.name == "src"), package)
    if not package.is_relative_to(around) and not around.is_relative_to(package):
        around = package
    folders = [package, around] + ([workspace] if workspace is not None else [])
    return [Place(folder.name or str(folder), folder) for folder in dict.fromkeys(folders)]


def make_robot(
    file: Path, name: str, places: list[Place], arguments: Mapping[str, str] | None = None
) -> Made:
    """Returns the files of a robot.

    Args:
        file: the URDF, xacro or SDF file.
        name: the name of the robot, of which the names of its files are made.
        places: where packages and meshes are searched.
        arguments: values of the arguments of macros.

    Raises:
        DocumentError: the file cannot be read.
        NoDriveError: it has no drive that can be simulated.
    """
    urdf, meshes, source = read_source(file, file.name, places, arguments, is_lenient=True)
    root = etree.fromstring(source.text, etree.XMLParser(resolve_entities=False, no_network=True))

    def place(line: int) -> str:
        path, number = source.place(line)
        return f"{os.path.relpath(path, file.parent)}:{number}"

    report = Report(place, file.name)
    base = find_base(urdf, root, meshes, report)
    joints = _motors(urdf, base, report)
    sensors = find_sensors(root, urdf.links, report)
    _frictions(urdf, report)
    _leave_out(root, report)
    report.left_out += [
        f"{file.name}:{note.line}: {note.message}" for note in urdf.notes if not _is_read(note.message)
    ]
    files = _copy_meshes(root, file, places)
    for element in root.iter(etree.Element):
        element.attrib.pop(LINE, "")
    title = f"{name}.urdf"
    files[title] = etree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"
    document: dict[str, Any] = {
        "format": "bt-studio/robot",
        "version": 1,
        "name": root.get("name") or name,
        "description": f"Imported from {file.name}.",
        "urdf": title,
        "drive": {
            "kind": "differential",
            "left": list(base.left),
            "right": list(base.right),
            "wheel_radius": round(base.radius, 6),
            "track": round(base.track, 6),
            "max_linear": round(base.max_linear, 4),
            "max_angular": round(base.max_angular, 4),
            "wheel_torque": round(base.torque, 4),
        },
        "wheels": [*dict.fromkeys(urdf.joints[joint].child for joint in base.joints), *base.castors],
        "friction": dict.fromkeys(base.sliding, 0.0),
        "joints": joints,
        "sensors": sensors,
    }
    document = {key: value for key, value in document.items() if value not in ({}, []) or key == "sensors"}
    return Made(files, document, base, report)


def _motors(urdf: Urdf, base: Base, report: Report) -> list[dict[str, Any]]:
    """Returns a motor for each joint with limits that no other joint leads."""
    made: list[dict[str, Any]] = []
    for joint in urdf.joints.values():
        if joint.mimic is not None:
            report.taken.append(f"the joint {joint.name} follows {joint.mimic.joint}")
        elif joint.limits is not None and joint.name not in base.joints:
            if len(made) == MOST_MOTORS:
                report.left_out.append(
                    f"the motor of the joint {joint.name}: a robot has {MOST_MOTORS} at most"
                )
                continue
            topic = "/" + re.sub(r"[^A-Za-z0-9_/]", "_", joint.name) + "/command"
            low, high = joint.limits
            start = min(max(0.0, low), high)
            torque = joint.effort or HOLD_NM
            made.append({"joint": joint.name, "topic": topic, "torque": min(torque, 1e6), "start": start})
            report.taken.append(f"the joint {joint.name}, {low:.3g} to {high:.3g}: its target is on {topic}")
    return made


def _frictions(urdf: Urdf, report: Report) -> None:
    for link, friction in urdf.friction.items():
        report.taken.append(f"the friction of the link {link}: {friction:g}, from Gazebo's")


def _leave_out(root: etree._Element, report: Report) -> None:
    for child in root:
        if isinstance(child.tag, str) and child.tag not in _QUIET:
            report.leave_out(child, f"<{child.tag}> is not read")
    for plugin in root.iterfind("gazebo/plugin"):
        name = plugin.get("filename") or plugin.get("name") or ""
        report.leave_out(plugin, f"the plugin {name} does not run here")


def _is_read(note: str) -> bool:
    """Returns whether a note of the conversion is about a part that the import reads itself."""
    return note.startswith(("<sensor>", "<plugin>"))


def _copy_meshes(root: etree._Element, file: Path, places: list[Place]) -> dict[str, bytes]:
    """Returns the mesh files by their new names, which the document gets."""
    packages = Packages(file.parent, places, installed_places(os.environ))
    files: dict[str, bytes] = {}
    names: dict[Path, str] = {}
    for mesh in root.iterfind("link/*/geometry/mesh"):
        try:
            path = mesh_path(mesh.get("filename", ""), file.parent, packages).resolve()
            data = path.read_bytes()
        except (MeshError, OSError):  # it is in the notes already, with its line
            continue
        if path not in names:
            beside = bundle(path.name, data, Companions(path, packages.may_read).read)
            name, number = _name(path, 1, has_folder=bool(beside)), 1
            while not has_room(name, beside, files):
                number += 1
                name = _name(path, number, has_folder=bool(beside))
            files |= {f"{PurePosixPath(name).parent}/{own}": content for own, content in beside.items()}
            names[path], files[name] = name, data
        mesh.set("filename", names[path])
    return files


def _name(path: Path, number: int, *, has_folder: bool) -> str:
    """Returns the name of a copy of a mesh; in a separate folder if files lie beside it."""
    stem = path.stem if number == 1 else f"{path.stem}_{number}"
    return f"meshes/{stem}/{path.name}" if has_folder else f"meshes/{stem}{path.suffix}"
