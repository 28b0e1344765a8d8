"""The launch files of a project as parts of its ROS 2 package.

In the project a node may be a Python file, named by its path (`exec: launch/talker.py`). In the package such
a file is installed as an executable of the package, and the launch file names the executable. All other files
in `launch/` are installed beside the launch files, so that `$(dirname)` finds them.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping  # noqa: TC003
from pathlib import PurePosixPath
from posixpath import normpath
from xml.sax.saxutils import quoteattr

import yaml

from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.package.rosdep import rosdep_table

FOLDER = "launch/"
DEPENDENCIES = {".py": (), ".yaml": ("launch_yaml",), ".yml": ("launch_yaml",), ".xml": ("launch_xml",)}
# As `ros2 launch` completes names: a dot or an underscore before the word.
_LAUNCH_FILE = re.compile(r"launch/(?:.*[/._])?launch\.(py|ya?ml|xml)", re.DOTALL)
_NAMED_FILE = re.compile(rb"""(?:\$\(dirname\)/|\b)((?:\.\./)*[\w./-]*launch\.(?:py|ya?ml|xml))\b""")
_SHEBANG = b"#!/usr/bin/env -S python3 -mtree_gardener.ros_script\n"
# The kernel gives what follows the interpreter as one word: `setuptools` writes the path of Python there.
_PYTHON_SHEBANG = re.compile(rb"#!\s*\S*(?:/env\s+|/)python[\d.]*\s*\n")
_PLAIN = re.compile(r"[A-Za-z_][\w.]*")
_XML_NODE = re.compile(r"<node\b[^>]*>")
_XML_EXEC = re.compile(r"""\bexec\s*=\s*(?P<quote>["'])(?P<path>[^"']+)(?P=quote)""")
_HERE = "$(dirname)/"
# `pkg: x` and `pkg="x"`, `$(find-pkg-share x)`, and the equivalent in Python.
_PACKAGES = re.compile(
    r"""\bpkg["']?\s*[:=]\s*["']?(\w+)|\$\(find-pkg-(?:share|prefix) (\w+)\)"""
    r"""|\bpackage\s*=\s*["'](\w+)["']"""
    r"""|\b(?:FindPackage(?:Share|Prefix)|get_package_(?:share_directory|prefix))\(\s*["'](\w+)["']"""
)


def launch_files(files: Mapping[str, bytes]) -> list[str]:
    """Returns the paths of the project's launch files."""
    return sorted(path for path in files if _LAUNCH_FILE.fullmatch(path))


def started_files(files: Mapping[str, bytes]) -> list[str]:
    """Returns the launch files that are started: those that no other one names, as an include does.

    Files that name each other in a ring are all started.
    """
    found = launch_files(files)
    names = {path: _named_in(path, files[path], found) for path in found}
    named = {other for path, others in names.items() for other in others if path not in names[other]}
    return [path for path in found if path not in named]


def _named_in(path: str, raw: bytes, known: list[str]) -> set[str]:
    folder = PurePosixPath(path).parent
    texts = {match[1].decode() for match in _NAMED_FILE.finditer(raw)}
    places = {normpath(place) for text in texts for place in (text, f"{folder}/{text}", f"{FOLDER}{text}")}
    return {other for other in known if other in places and other != path}


def dependencies_of(files: Mapping[str, bytes]) -> set[str]:
    """Returns the packages that launch files need: to read them, and to run their nodes."""
    readers = {name for path in launch_files(files) for name in DEPENDENCIES[PurePosixPath(path).suffix]}
    texts = (files[path].decode("utf-8", "replace") for path in launch_files(files))
    named = {name for text in texts for groups in _PACKAGES.findall(text) for name in groups}
    return readers | (named & rosdep_table().ros_packages)


def programs(files: Mapping[str, bytes]) -> dict[str, str]:
    """Returns the Python files that launch files start, each with the name of its executable.

    These are all beside the launch files, and others of the project whose name is in a launch file.
    """
    named: dict[str, str] = {}
    texts = b"\n".join(files[path] for path in launch_files(files))
    for path in sorted(files):
        is_named = path.startswith(FOLDER) or PurePosixPath(path).name.encode() in texts
        if is_named and path.endswith(".py") and not _LAUNCH_FILE.fullmatch(path):
            name = path.removeprefix(FOLDER).replace("/", "_")
            while name in named.values():
                name = f"_{name}"
            named[path] = name
    return named


def companions(files: Mapping[str, bytes]) -> list[str]:
    """Returns the other files in `launch/`, neither launch files nor programs, such as parameters."""
    return [
        path
        for path in sorted(files)
        if path.startswith(FOLDER) and not path.endswith(".py") and not _LAUNCH_FILE.fullmatch(path)
    ]


def as_program(raw: bytes) -> bytes:
    """Returns the Python file with the first line (`#!`) of an executable script that checks its messages.

    A first line of the user that has more than Python's name stays.
    """
    first = _PYTHON_SHEBANG.match(raw)
    if first is not None:
        return _SHEBANG + raw[first.end() :]
    return raw if raw.startswith(b"#!") else _SHEBANG + raw


def in_package(
    path: str, raw: bytes, package: str, known: Mapping[str, str]
) -> tuple[bytes, list[Diagnostic]]:
    """Returns a launch file that names the project's Python files as executables of the package.

    Also returns a warning for each name that is not understood.
    """
    text = raw.decode("utf-8", "surrogateescape")
    folder = str(PurePosixPath(path).parent)
    if path.endswith((".yaml", ".yml")):
        changes = _in_yaml(text, folder, package, known)
    elif path.endswith(".xml"):
        changes = _in_xml(text, folder, package, known)
    else:
        changes = []
    for start, end, new in sorted(set(changes), reverse=True):
        text = text[:start] + new + text[end:]
    return text.encode("utf-8", "surrogateescape"), list(_left(path, raw, text, package, known))


def _in_yaml(text: str, folder: str, package: str, known: Mapping[str, str]) -> list[tuple[int, int, str]]:
    """Yields changes (start, end, new text): `pkg` before each `exec` of a program, and its new name."""
    try:
        root = yaml.compose(text, Loader=yaml.SafeLoader)
    except (yaml.YAMLError, RecursionError):
        return []  # `launch` reports it with a better place
    ending = "\r\n" if "\r\n" in text else "\n"
    changes = []
    for mapping in _mappings(root):
        keys = {key.value: (key, value) for key, value in mapping.value if isinstance(key.value, str)}
        key, value = keys.get("exec", (None, None))
        if key is None or "pkg" in keys or not isinstance(value, yaml.ScalarNode):
            continue
        if program := _program(value.value, folder, known):
            between = ", " if mapping.flow_style else ending + " " * key.start_mark.column
            name = program if _PLAIN.fullmatch(program) else json.dumps(program)
            changes += [
                (key.start_mark.index, key.start_mark.index, f"pkg: {package}{between}"),
                (value.start_mark.index, value.end_mark.index, name),
            ]
    return changes


def _mappings(root: yaml.Node | None) -> Iterator[yaml.MappingNode]:
    """Yields every mapping of a document once, even if several places refer to it."""
    seen: set[int] = set()
    stack = [root] if root is not None else []
    while stack:
        node = stack.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        if isinstance(node, yaml.MappingNode):
            yield node
            stack.extend(part for pair in node.value for part in pair)
        elif isinstance(node, yaml.SequenceNode):
            stack.extend(node.value)


def _in_xml(text: str, folder: str, package: str, known: Mapping[str, str]) -> list[tuple[int, int, str]]:
    changes = []
    for tag in _XML_NODE.finditer(text):
        named = _XML_EXEC.search(tag.group())
        program = named and _program(named["path"], folder, known)
        if named and program and not re.search(r"\bpkg\s*=", tag.group()):
            new = f"pkg={quoteattr(package)} exec={quoteattr(program)}"
            changes.append((tag.start() + named.start(), tag.start() + named.end(), new))
    return changes


def _left(path: str, raw: bytes, text: str, package: str, known: Mapping[str, str]) -> Iterator[Diagnostic]:
    """Yields warnings for programs that the package's launch file still names by their path."""
    lines = raw.decode("utf-8", "replace").splitlines()
    for program_path, program in known.items():
        if not any(program_path in line.partition("#")[0] for line in text.splitlines()):
            continue
        for number, line in enumerate(lines, 1):
            column = line.partition("#")[0].find(program_path) + 1
            if column:
                place = Place(path, line=number, column=column)
                yield diagnostic("BT0911", place, file=program_path, package=package, program=program)


def _program(named: str, folder: str, known: Mapping[str, str]) -> str | None:
    """Returns the executable for a path, which is relative to the project or to the launch file.

    Else None.
    """
    if named.startswith(_HERE):
        return known.get(normpath(f"{folder}/{named.removeprefix(_HERE)}"))
    return known.get(normpath(named)) or known.get(normpath(f"{folder}/{named}"))
