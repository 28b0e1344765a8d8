"""Makes the table *Python import → rosdep key* from a copy of rosdistro's rosdep lists.

    python -m translator.package.make_rosdep FOLDER DATE > translator/package/rosdep.json

FOLDER holds `python.yaml` (rosdep keys) and `jazzy_packages.txt` (names of released packages).
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import Any

import yaml

UBUNTU = "noble"  # the Ubuntu of ROS 2 Jazzy
# Imports that do not have the name of their package.
KNOWN = {
    "attr": "python3-attrs",
    "bs4": "python3-bs4",
    "Crypto": "python3-pycryptodome",
    "cv2": "python3-opencv",
    "dateutil": "python3-dateutil",
    "docx": "python3-docx",
    "gi": "python3-gi",
    "git": "python3-git",
    "google.protobuf": "python3-protobuf",
    "mpl_toolkits": "python3-matplotlib",
    "OpenGL": "python3-opengl",
    "osgeo": "python3-gdal",
    "PIL": "python3-pil",
    "pkg_resources": "python3-pkg-resources",
    "py_trees": "py_trees",
    "PyQt5": "python3-pyqt5",
    "pyaudio": "python3-pyaudio",
    "serial": "python3-serial",
    "skimage": "python3-skimage",
    "sklearn": "python3-sklearn",
    "socketio": "python3-socketio",
    "PyKDL": "python_orocos_kdl_vendor",
    "tf2_ros": "tf2_ros_py",  # the package tf2_ros is C++
    "usb": "python3-usb",
    "websocket": "python3-websocket",
    "yaml": "python3-yaml",
    "zmq": "python3-zmq",
}


def is_for_ubuntu(entry: Any) -> bool:
    """Returns whether a rosdep entry has a package for the Ubuntu version of Jazzy."""
    rule = entry.get("ubuntu") if isinstance(entry, dict) else None
    if isinstance(rule, dict) and "pip" not in rule:
        rule = rule.get(UBUNTU, rule.get("*"))
    return bool(rule)


def import_names(key: str) -> list[str]:
    """Returns the imports that a rosdep key provides, judged by its name."""
    match = re.fullmatch(r"python3?-(.+?)(-pip)?", key)
    if match is None:
        return []
    name = match.group(1).replace("-", "_").replace(".", "_")
    return [name] if name.isidentifier() else []


def make_table(python: dict[str, Any], packages: list[str], date: str) -> dict[str, Any]:
    """Returns the table. If several keys provide one import, Debian packages have priority over pip."""
    keys = {key for key, entry in python.items() if is_for_ubuntu(entry)}
    imports: dict[str, str] = {}
    for key in sorted(keys, key=lambda key: (key.endswith("-pip"), not key.startswith("python3-"), key)):
        for name in import_names(key):
            imports.setdefault(name, key)
    imports.update({name: key for name, key in KNOWN.items() if key in keys or key in packages})
    return {
        "source": "github.com/ros/rosdistro (BSD)",
        "date": date,
        "imports": dict(sorted(imports.items())),
        "ros_packages": sorted(packages),
    }


def main(folder: str, date: str) -> None:
    python = yaml.safe_load(Path(folder, "python.yaml").read_text(encoding="utf-8"))
    packages = Path(folder, "jazzy_packages.txt").read_text(encoding="utf-8").split()
    table = make_table(python, packages, date)
    sys.stdout.write(json.dumps(table, indent=1) + "\n")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
