"""The launch files of a project as parts of its ROS 2 package.

In the project a node may be a Python file, named by its path (`exec: launch/talker.py`). In the package such
a file is installed as an executable of the package, and the launch file names it so.
"""

from __future__ import annotations

import re
from collections.abc import Mapping  # noqa: TC003
from pathlib import PurePosixPath

from translator.diagnostic import Diagnostic, Place, diagnostic

FOLDER = "launch/"
DEPENDENCIES = {".py": (), ".yaml": ("launch_yaml",), ".yml": ("launch_yaml",), ".xml": ("launch_xml",)}
_LAUNCH_FILE = re.compile(r"launch/.+\.launch\.(py|ya?ml|xml)")
_SHEBANG = b"#!/usr/bin/env python3\n"
_NAMED = re.compile(r"""\bexec(?:utable)?\s*[:=]\s*["']?(?P<path>[^\s"',}#]+\.py)""")
_BLOCK = re.compile(
    r"""^(?P<indent>\s*(?:-\s+)?)exec:\s*(?P<quote>["']?)(?P<path>[^\s"'#]+\.py)(?P=quote)(?P<rest>\s*(?:\#.*)?)$"""
)


def launch_files(files: Mapping[str, bytes]) -> list[str]:
    """Returns the paths of the project's launch files."""
    return sorted(path for path in files if _LAUNCH_FILE.fullmatch(path))


def dependencies_of(paths: list[str]) -> set[str]:
    """Returns the packages that read these launch files, beside `launch` itself."""
    return {name for path in paths for name in DEPENDENCIES[PurePosixPath(path).suffix]}


def programs(files: Mapping[str, bytes]) -> dict[str, str]:
    """Returns the Python files beside the launch files, each with the name of its executable."""
    paths = [p for p in sorted(files) if p.startswith(FOLDER) and p.endswith(".py")]
    return {
        path: path.removeprefix(FOLDER).replace("/", "_")
        for path in paths
        if not _LAUNCH_FILE.fullmatch(path)
    }


def as_program(raw: bytes) -> bytes:
    """Returns a Python file that the system can start."""
    return raw if raw.startswith(b"#!") else _SHEBANG + raw


def in_package(
    path: str, raw: bytes, package: str, known: Mapping[str, str]
) -> tuple[bytes, list[Diagnostic]]:
    """Returns a launch file that names the project's Python files as executables of the package.

    Also returns a warning for each that is named in a way that is not understood.
    """
    if path.endswith(".py"):
        return raw, []
    found: list[Diagnostic] = []
    lines = []
    for number, line in enumerate(raw.decode("utf-8", "replace").splitlines(keepends=True), 1):
        body = line.rstrip("\r\n")
        named = _NAMED.search(body)
        program = named and _program(named["path"], known)
        block = _BLOCK.match(body)
        if program and block:
            indent = re.sub(r"\S", " ", block["indent"])
            ending = line[len(body) :] or "\n"
            lines += [
                f"{block['indent']}pkg: {package}{ending}",
                f"{indent}exec: {program}{block['rest']}{ending}",
            ]
            continue
        if program and named:
            place = Place(path, line=number, column=named.start("path") + 1)
            found.append(diagnostic("BT0911", place, file=named["path"], package=package, program=program))
        lines.append(line)
    return "".join(lines).encode(), found


def _program(path: str, known: Mapping[str, str]) -> str | None:
    """The executable that a path means, which is looked for from the project, then from the launch file."""
    return known.get(path) or known.get(FOLDER + path)
