"""Finds the folder that a name of a ROS package or of a Gazebo model stands for.

`package://NAME/…`, `model://NAME/…`, `file://…`, `$(find NAME)`, `$(find-pkg-share NAME)` and
`ros_pkg="NAME"` all ask here, so that they all mean the same folder: the one whose `package.xml` or
`model.config` has that name, or a model's folder of that name. To use it on the disk::

    packages = Packages(
        file.parent,  # where the name is written: the nearest folder of that name counts
        [Place("the robot's folder robots/cart", robot), Place("the project", project)],
    )
    folder = packages.folder("cart_description")  # raises MissingPackageError, one sentence for the user
    mesh = packages.file("package://cart_description/meshes/a.stl")  # as above, or PackageError
    packages.notes  # "two folders are named …", to show

and for files in memory, as an archive or a request brings them::

    folders = package_folders({"src/pkg_b/package.xml": b"<package><name>pkg_b</name></package>"})
    nearest(folders["pkg_b"], "src/pkg_a/trees")  # "src/pkg_b"

No file outside of the places is returned: a link that leads out is refused.
"""

import itertools
import os
import pathlib
import posixpath
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final, NamedTuple
from urllib.parse import unquote

MANIFESTS: Final = ("package.xml", "model.config")
SCHEMES: Final = ("package://", "model://")
MOST_FOLDERS: Final = 20_000
_MOST_BYTES: Final = 1_000_000
_IGNORED: Final = frozenset({"build", "install", "log", "node_modules", "__pycache__"})
_MARKS: Final = frozenset({"COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE"})


class PackageError(Exception):
    """A name leads to no file that may be read; the text is a sentence."""


class MissingPackageError(PackageError):
    """Nobody has a package of that name."""


class Place(NamedTuple):
    """A folder in which packages are searched, and its name in sentences."""

    shown: str
    folder: pathlib.Path


def manifest_name(data: bytes) -> str | None:
    """Returns the name that a `package.xml` or `model.config` gives; None if it is none."""
    if len(data) > _MOST_BYTES or b"<!DOCTYPE" in data:
        return None
    try:
        root = ET.fromstring(data)  # noqa: S314 - without a DOCTYPE there are no entities
    except (ET.ParseError, ValueError, LookupError):
        return None
    name = (root.findtext("name") or "").strip()
    return name if root.tag in ("package", "model") and name else None


def package_folders(files: Mapping[str, bytes]) -> dict[str, list[str]]:
    """Returns the folders of each name, of files by their paths with slashes; the root is ``""``."""
    found: dict[str, list[str]] = {}
    for path in sorted(files):
        folder, _, file = path.rpartition("/")
        if file in MANIFESTS:
            _add(found, folder, file, files[path])
    return found


def nearest(folders: Iterable[str], to: str) -> str:
    """Returns the folder with the fewest steps from another one, up and down; the first of equals."""
    return min(folders, key=lambda folder: (_steps(folder, to), folder))


def installed_places(environment: Mapping[str, str]) -> list[Place]:
    """Returns the folders of installed packages and models that variables of ROS and Gazebo name."""
    shares = [pathlib.Path(prefix, "share") for prefix in _listed(environment, "AMENT_PREFIX_PATH")]
    models = [
        pathlib.Path(path)
        for variable in ("GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH")
        for path in _listed(environment, variable)
    ]
    return [Place("what is installed", folder) for folder in (*shares, *models)]


class Packages:
    """The packages that can be named in a file.

    Args:
        near: the folder of that file.
        places: the folders that are searched, with all below them.
        installed: the folders whose direct subfolders are searched if no place has the name.
    """

    def __init__(self, near: pathlib.Path, places: Sequence[Place], installed: Sequence[Place] = ()) -> None:
        self.near = near
        self.places = tuple(places)
        self.installed = tuple(installed)
        self.notes: list[str] = []
        self._index: dict[str, list[str]] | None = None
        self._known: dict[str, pathlib.Path] = {}

    def folder(self, name: str) -> pathlib.Path:
        """Returns the folder of a package.

        Raises:
            MissingPackageError: nobody has that name.
        """
        if name not in self._known:
            self._known[name] = self._find(name)
        return self._known[name]

    def file(self, name: str) -> pathlib.Path:
        """Returns the path that a URI or a relative path names. The file need not exist.

        Raises:
            MissingPackageError: nobody has the package that it names.
            PackageError: it lies outside of all places.
        """
        scheme = next((scheme for scheme in SCHEMES if name.startswith(scheme)), "")
        if scheme:
            package, _, rest = unquote(name.removeprefix(scheme)).partition("/")
            path = self.in_source(self.folder(package) / rest.lstrip("/"))
        else:
            given = name.removeprefix("file://")
            path = self.near / (unquote(given) if given != name else name)
        if not self.may_read(path):
            raise PackageError(f"{name} lies outside of {self._shown()}")
        return path

    def in_source(self, path: pathlib.Path) -> pathlib.Path:
        """Returns a path of a package, or where its file lies before a build installs it, if that is clear.

        `$(find NAME)/urdf/a.xacro` is `description/urdf/a.xacro` of a package whose build installs what is in
        `description/`.
        """
        known = self._known.values()
        folder = next((each for each in known if path.is_relative_to(each)), None)
        if folder is None or path.exists():
            return path
        below = path.relative_to(folder)
        found = [up for up in _matching(folder, below) if self.may_read(up)]
        if len(found) != 1:
            return path
        note = (
            f"{below.as_posix()} is {found[0].relative_to(folder).as_posix()} in {self._short(str(folder))}"
        )
        if note not in self.notes:
            self.notes.append(note)
        return found[0]

    def may_read(self, path: pathlib.Path) -> bool:
        """Returns whether a path lies in a place, with all links followed."""
        real = os.path.realpath(path)
        folders = [place.folder for place in (*self.places, *self.installed)]
        return any(_is_within(real, folder) for folder in folders)

    def _find(self, name: str) -> pathlib.Path:
        if self._index is None:
            self._index = self._search()
        folders = self._index.get(name)
        if folders:
            here = os.path.realpath(self.near).replace(os.sep, "/")
            found = nearest(folders, here)
            if len(folders) > 1:
                others = ", ".join(self._short(folder) for folder in folders if folder != found)
                text = (
                    f"{name!r} is the name of {len(folders)} folders: {self._short(found)} is the nearest, "
                )
                self.notes.append(f"{text}so {others} {'is' if len(folders) == 2 else 'are'} not used")
            return pathlib.Path(found)
        if name and "/" not in name and name not in (".", ".."):
            for place in self.installed:
                path = place.folder / name
                if path.is_dir():
                    return path
        raise MissingPackageError(
            f"no folder is the package {name!r}: {self._shown()} "
            f"{'was' if len(self.places) == 1 else 'were'} searched; copy the folder whose package.xml or "
            f"model.config has that name into {self.places[0].shown}"
        )

    def _search(self) -> dict[str, list[str]]:
        index: dict[str, list[str]] = {}
        budget = iter(range(MOST_FOLDERS))
        for place in self.places:
            root = os.path.realpath(place.folder)
            for folder, file in _manifests(root, budget):
                path = pathlib.Path(folder, file)
                if self.may_read(path):
                    _add(index, folder.replace(os.sep, "/"), file, _read(path))
        return index

    def _short(self, folder: str) -> str:
        for place in self.places:
            if _is_within(folder, place.folder):
                below = os.path.relpath(folder, os.path.realpath(place.folder))
                return place.shown if below == "." else f"{below} of {place.shown}"
        return folder

    def _shown(self) -> str:
        return " and ".join(dict.fromkeys(place.shown for place in self.places))


def _add(index: dict[str, list[str]], folder: str, file: str, data: bytes) -> None:
    names = {manifest_name(data)}
    if file == "model.config":  # Gazebo finds a model by the name of its folder
        names.add(posixpath.basename(folder))
    for name in names:
        folders = index.setdefault(name, []) if name else []
        if folder not in folders:
            folders.append(folder)


def _manifests(root: str, budget: Iterator[int]) -> Iterator[tuple[str, str]]:
    for folder, below, files in os.walk(root):
        if next(budget, None) is None:
            return
        if not _MARKS.isdisjoint(files):
            below.clear()
            continue
        below[:] = sorted(name for name in below if name not in _IGNORED and not name.startswith("."))
        yield from ((folder, file) for file in MANIFESTS if file in files)


def _matching(folder: pathlib.Path, below: pathlib.PurePath) -> list[pathlib.Path]:
    """Returns the files below a folder whose paths end as `below`."""
    found = []
    for root, folders, files in itertools.islice(os.walk(folder), MOST_FOLDERS):
        folders[:] = [name for name in folders if name not in _IGNORED and not name.startswith(".")]
        path = pathlib.Path(root, below.name)
        if below.name in files and path.parts[-len(below.parts) :] == below.parts:
            found.append(path)
    return found


def _read(path: pathlib.Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(_MOST_BYTES + 1)
    except OSError:
        return b""


def _steps(folder: str, to: str) -> int:
    one, two = ([part for part in path.split("/") if part] for path in (folder, to))
    common = next((i for i, (a, b) in enumerate(zip(one, two, strict=False)) if a != b), None)
    return len(one) + len(two) - 2 * (min(len(one), len(two)) if common is None else common)


def _listed(environment: Mapping[str, str], variable: str) -> list[str]:
    return [path for path in environment.get(variable, "").split(os.pathsep) if path]


def _is_within(real: str, folder: pathlib.Path) -> bool:
    root = os.path.realpath(folder)
    return real == root or real.startswith(root.rstrip(os.sep) + os.sep)
