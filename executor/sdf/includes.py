"""Puts included models, lights and actors where a world or a model includes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.sdf.dialect import SdfError, line_of, parse, version_of
from executor.sdf.files import model_file
from executor.sdf.values import text_of
from executor.universes.document import Problem
from tree_gardener.packages import PackageError

if TYPE_CHECKING:
    from collections.abc import Callable

    from lxml import etree

    from executor.sdf.files import Files

    Report = Callable[[etree._Element, str], None]

FILE: Final = "bts_file"
VERSION: Final = "bts_version"
MERGED: Final = "bts_merged"
PLACEMENT: Final = "placement_frame"
MAX_LEVELS: Final = 32
MAX_INCLUDES: Final = 5_000
EVERYWHERE: Final = ("ground_plane", "sun")
"""Models of Gazebo's collection that every universe has."""
_CONTENT: Final = ("model", "light", "actor")


def file_of(element: etree._Element) -> str:
    """Returns the file that an element was read from."""
    return _nearest(element, FILE)


def is_before(element: etree._Element, major: int, minor: int) -> bool:
    """Returns whether the file of an element is of an older version of SDF."""
    words = _nearest(element, VERSION).split(".")
    return (int(words[0]), int(words[1])) < (major, minor) if len(words) == 2 else False


def _nearest(element: etree._Element, name: str) -> str:
    above: etree._Element | None = element
    while above is not None:
        value = above.get(name)
        if value is not None:
            return value
        above = above.getparent()
    return ""


def problem_at(element: etree._Element, message: str) -> Problem:
    """Returns a finding at an element; it names the file if that is an included one."""
    top = element.getroottree().getroot()
    file = file_of(element)
    where = f"{file}: " if file and file != top.get(FILE) else ""
    return Problem(where + message, line_of(element), code="BTU006")


def load(data: bytes, file: str, files: Files, report: Report) -> etree._Element:
    """Returns the `<sdf>` element of a document, with all that it includes.

    Args:
        data: the document.
        file: its path, from which others are found.
        files: the other files.
        report: is called with an `<include>` that is left out, and the reason.

    Raises:
        SdfError: the document cannot be read.
    """
    root = parse(data, file)
    _mark(root, root, file)
    work = _Includes(files, report)
    for child in root:
        if child.tag in ("world", "model"):
            work.expand(child, (file,))
    return root


def _mark(element: etree._Element, root: etree._Element, file: str) -> None:
    element.set(FILE, file)
    element.set(VERSION, ".".join(map(str, version_of(root, file))))


class _Includes:
    def __init__(self, files: Files, report: Report) -> None:
        self._files = files
        self._report = report
        self._count = 0

    def expand(self, scope: etree._Element, chain: tuple[str, ...]) -> None:
        for child in list(scope):
            if child.tag == "model":
                self.expand(child, chain)
            elif child.tag == "include":
                content = self._content(child, chain)
                if content is None:
                    scope.remove(child)
                else:
                    scope.replace(child, content)
                    if content.tag == "model":
                        self.expand(content, (*chain, file_of(content)))

    def _content(self, include: etree._Element, chain: tuple[str, ...]) -> etree._Element | None:
        uri = text_of(include, "uri")
        self._count += 1
        if uri.rstrip("/").rpartition("/")[2].lower().replace(" ", "_") in EVERYWHERE:
            return self._of_every_universe(include, uri, chain)
        try:
            path, root = self._read(uri, file_of(include), chain)
            content = next((child for child in root if child.tag in _CONTENT), None)
            if content is None:
                raise PackageError(f"{path} has no model, light or actor")
        except (PackageError, SdfError) as error:
            self._report(include, f"<include> of {uri}: {error}")
            return None
        _mark(content, root, path)
        self._place(include, content)
        return content

    def _of_every_universe(
        self, include: etree._Element, uri: str, chain: tuple[str, ...]
    ) -> etree._Element | None:
        """Returns Gazebo's ground or sun, if they are there; every universe has them otherwise."""
        try:
            path, root = self._read(uri, file_of(include), chain)
        except (PackageError, SdfError):
            return None
        content = next((child for child in root if child.tag in _CONTENT), None)
        if content is not None:
            _mark(content, root, path)
            self._place(include, content)
        return content

    def _read(self, uri: str, file: str, chain: tuple[str, ...]) -> tuple[str, etree._Element]:
        if len(chain) > MAX_LEVELS or self._count > MAX_INCLUDES:
            limit = f"{MAX_LEVELS} levels" if len(chain) > MAX_LEVELS else str(MAX_INCLUDES)
            raise PackageError(f"more than {limit} of includes")
        path = model_file(self._files, self._files.find(uri, file))
        if path in chain:
            ring = " → ".join((*chain[chain.index(path) :], path))
            raise PackageError(f"the files include each other: {ring}")
        data = self._files.read(path)
        if data is None:
            raise PackageError(f"there is no file {path}")
        return path, parse(data, path)

    @staticmethod
    def _place(include: etree._Element, content: etree._Element) -> None:
        """Gives included content the name, the pose and the rest that its `<include>` says."""
        name = text_of(include, "name")
        if name:
            content.set("name", name)
        for tag in ("pose", "static"):
            own = include.find(tag)
            if own is None or (tag == "static" and content.tag != "model"):
                continue
            for old in content.findall(tag):
                content.remove(old)
            if tag == "pose" and is_before(include, 1, 7) and own.get("frame"):
                own.set("relative_to", own.get("frame", ""))
            content.append(own)
        placement = text_of(include, PLACEMENT)
        if placement:
            content.set(PLACEMENT, placement)
        if is_true_attribute(include, "merge"):
            content.set(MERGED, "1")


def is_true_attribute(element: etree._Element, name: str) -> bool:
    """Returns a truth value that an attribute gives."""
    return element.get(name, "").strip().lower() in ("true", "1")
