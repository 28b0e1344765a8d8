"""The files that a mesh file names: materials of OBJ, buffers of glTF, pictures of all of them."""

from __future__ import annotations

import json
import posixpath
import re
from typing import TYPE_CHECKING, Any, Final
from urllib.parse import unquote

from executor.world.geometry.pictures import shrunk

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

__all__ = ["Companions", "bundle", "gltf_tree", "has_room", "named_files"]

MOST_BYTES: Final = 50_000_000
_PICTURES: Final = (".png", ".jpg", ".jpeg")
_LIBRARY: Final = re.compile(rb"^[ \t]*mtllib[ \t]+(.+?)[ \t\r]*$", re.MULTILINE)
_MAP: Final = re.compile(rb"^[ \t]*map_Kd[ \t]+(?:.*[ \t])?(\S+)[ \t\r]*$", re.MULTILINE | re.IGNORECASE)
_IMAGE: Final = re.compile(rb"<init_from>\s*([^<]*?)\s*</init_from>")


def named_files(name: str, data: bytes) -> list[str]:
    """Returns the files that a mesh file, or a file of materials, names, relative to its folder."""
    suffix = posixpath.splitext(name)[1].lower()
    if suffix == ".gltf":
        tree = gltf_tree(data)
        lists = [each for kind in ("buffers", "images") if isinstance(each := tree.get(kind), list)]
        uris = [each.get("uri") for entries in lists for each in entries if isinstance(each, dict)]
        found = [unquote(uri) for uri in uris if isinstance(uri, str) and not uri.startswith("data:")]
    else:
        pattern = {".obj": _LIBRARY, ".mtl": _MAP, ".dae": _IMAGE}.get(suffix)
        words = [] if pattern is None else pattern.findall(data)
        found = [word.decode("utf-8", "replace").replace("\\", "/") for word in words]
        if suffix == ".dae":  # its references between elements have no suffix of a picture
            found = [unquote(each) for each in found if _is_picture(each)]
    return list(dict.fromkeys(found))


def gltf_tree(data: bytes) -> dict[str, Any]:
    """Returns the document of a `.gltf` file; an empty one if it is none."""
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return {}
    return tree if isinstance(tree, dict) else {}


def bundle(name: str, data: bytes, read: Callable[[str], bytes | None]) -> dict[str, bytes]:
    """Returns what a copy of a mesh file needs beside it, by file name; pictures are made small.

    Args:
        name: the mesh file's name.
        data: its content.
        read: returns the content of a file that it names; None without one that may be read.
    """
    found: dict[str, bytes] = {}
    for named in named_files(name, data):
        content = read(named)
        own = posixpath.basename(named)
        if content is None or own in found or own == name:
            continue
        if _is_picture(own):
            small = shrunk(content)
            if small is not None:
                found[own] = small
            continue
        if name.lower().endswith(".mtl"):
            continue  # materials name pictures alone: what else they name may lead back to them
        found[own] = content
        if own.lower().endswith(".mtl"):
            found |= {key: value for key, value in bundle(own, content, read).items() if key not in found}
    return found


def has_room(path: str, beside: Mapping[str, bytes], files: Mapping[str, bytes]) -> bool:
    """Returns whether a copy of a mesh may have a path: no other file is there, or where its companions go.

    Args:
        path: the path.
        beside: its companions, by file name.
        files: what is written already, by path.
    """
    folder = posixpath.dirname(path)
    return path not in files and all(
        files.get(f"{folder}/{own}", content) == content for own, content in beside.items()
    )


class Companions:
    """Reads the files that a mesh file names: where it says, or beside it by their names.

    Args:
        path: the mesh file.
        may_read: says of a path whether it may be read; those below the file's folder if it is None.
        suffixes: of the files that are read; all if there are none.
    """

    def __init__(
        self, path: Path, may_read: Callable[[Path], bool] | None = None, suffixes: tuple[str, ...] = ()
    ) -> None:
        self._folder = path.parent
        self._may_read = may_read or self._is_below
        self._suffixes = suffixes
        self.file_name = path.name

    def get(self, name: str) -> bytes:
        """Returns the content of a file.

        Raises:
            OSError: without one that may be read.
        """
        wanted = unquote(name.strip()).replace("\\", "/")
        for each in (wanted, posixpath.basename(wanted)):
            path = self._folder / each
            if self._suffixes and path.suffix.lower() not in self._suffixes:
                continue
            if self._may_read(path) and path.is_file() and path.stat().st_size <= MOST_BYTES:
                return path.read_bytes()
        raise FileNotFoundError(f"{wanted} is not there")

    __getitem__ = get

    def read(self, name: str) -> bytes | None:
        """Returns the content of a file; None without one that may be read."""
        try:
            return self.get(name)
        except (OSError, ValueError):
            return None

    def _is_below(self, path: Path) -> bool:
        return path.resolve().is_relative_to(self._folder.resolve())


def _is_picture(name: str) -> bool:
    return name.lower().endswith(_PICTURES)
