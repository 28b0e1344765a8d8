"""The files that an SDF document may name: in memory, as uploads bring them, or on the disk."""

from __future__ import annotations

import contextlib
import posixpath
from pathlib import Path
from typing import TYPE_CHECKING, Protocol
from urllib.parse import unquote

from executor.sdf.dialect import NEWEST
from tree_gardener.packages import (
    MissingPackageError,
    PackageError,
    Packages,
    manifest_name,
    nearest,
    package_folders,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_MANIFEST = "model.config"


class Files(Protocol):
    """Finds and reads files."""

    @property
    def notes(self) -> Sequence[str]:
        """Notes about the names that were looked up, such as two folders of one name."""

    def find(self, uri: str, base: str) -> str:
        """Returns the path that a URI in the file `base` means.

        Raises:
            PackageError: it means no file that may be read.
        """

    def read(self, path: str) -> bytes | None:
        """Returns the content of a file; None if there is none."""


class NoFiles:
    """No other files: a document that came alone."""

    notes: Sequence[str] = ()

    def find(self, uri: str, base: str) -> str:
        """Refuses."""
        raise PackageError(f"{uri} is not there: only {base} was given")

    def read(self, path: str) -> bytes | None:
        """Returns None."""
        return None


class MemoryFiles:
    """Files by their paths."""

    notes: Sequence[str] = ()

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self._files = files
        self._folders = package_folders(files)
        for path in sorted(files):
            folder = posixpath.dirname(path)
            if folder and path.endswith(".sdf"):
                found = self._folders.setdefault(posixpath.basename(folder), [])
                if not found:
                    found.append(folder)

    def find(self, uri: str, base: str) -> str:
        """Finds a file, or a folder, by its URI."""
        here = posixpath.dirname(base)
        name, rest = _model_of(uri)
        if name:
            if name not in self._folders:
                return self._below_a_path(name, rest, here)
            return posixpath.normpath(posixpath.join(nearest(self._folders[name], here), rest))
        path = posixpath.normpath(posixpath.join(here, unquote(uri.removeprefix("file://")).lstrip("/")))
        if path.startswith("../"):
            raise PackageError(f"{uri} lies outside of what is imported")
        first, _, rest = unquote(uri.removeprefix("file://")).partition("/")
        if path in self._files or self._has(path):
            return path
        if first in self._folders:
            return posixpath.normpath(posixpath.join(nearest(self._folders[first], here), rest))
        with contextlib.suppress(PackageError):  # Gazebo looks below the folders of its search path
            return self._below_a_path(first, rest, here)
        return path

    def read(self, path: str) -> bytes | None:
        """Returns a file, or what a model's folder names."""
        return self._files.get(path)

    def _below_a_path(self, name: str, rest: str, here: str) -> str:
        """Returns a file or folder below a folder of that name, which need not be a model itself."""
        wanted = f"/{posixpath.join(name, rest).rstrip('/')}/"
        ends = [f"/{path}/".find(wanted) for path in self._files]
        found = {
            path[: end + len(wanted) - 2] for path, end in zip(self._files, ends, strict=True) if end >= 0
        }
        if not found or not rest:
            raise MissingPackageError(f"no folder of what is imported is the model {name!r}")
        return nearest(found, here)

    def _has(self, folder: str) -> bool:
        return any(path.startswith(f"{folder}/") for path in self._files)


class DiskFiles:
    """Files below the places of a resolver of packages."""

    def __init__(self, packages: Packages) -> None:
        self._packages = packages

    @property
    def notes(self) -> Sequence[str]:
        """Those of the packages."""
        return self._packages.notes

    def find(self, uri: str, base: str) -> str:
        """Finds a file, or a folder, by its URI."""
        self._packages.near = Path(base).parent
        name, rest = _model_of(uri)
        if name:
            try:
                path = self._packages.file(f"model://{name}/{rest}")
            except MissingPackageError as error:
                found = self._found_below(name, rest)
                if found is None:
                    raise error from None
                path = found
        else:
            path = self._packages.file(uri)
            first, _, rest = uri.removeprefix("file://").partition("/")
            if not path.exists() and first:
                # Gazebo looks below the folders of its search path.
                found = self._found_below(unquote(first), unquote(rest), is_whole=True)
                if found is not None:
                    return str(found)
                with contextlib.suppress(MissingPackageError):
                    path = self._packages.file(f"model://{first}/{rest}")
        return str(path)

    def _found_below(self, name: str, rest: str, *, is_whole: bool = False) -> Path | None:
        """Returns a file or folder below a folder of that name, which need not be a model itself.

        If it is whole, the name may be the folder itself.
        """
        if not (rest or is_whole):
            return None
        near = self._packages.near
        folders = [near, *near.parents]
        paths = (base / below / name / rest for base in folders for below in ("", "models"))
        return next((path for path in paths if self._packages.may_read(path) and path.exists()), None)

    def read(self, path: str) -> bytes | None:
        """Returns a file."""
        try:
            return Path(path).read_bytes()
        except OSError:
            return None


def _model_of(uri: str) -> tuple[str, str]:
    """Returns the model that a URI names, and the path in it; ("", "") for other URIs.

    A model of the collection of Gazebo in the net is taken from what is there, by its name.
    """
    for scheme in ("model://", "package://"):
        if uri.startswith(scheme):
            name, _, rest = unquote(uri.removeprefix(scheme)).partition("/")
            return name, rest
    if uri.startswith(("https://", "http://")):
        parts = unquote(uri).split("/")
        if "models" in parts[:-1]:
            name, *below = parts[parts.index("models") + 1 :]
            below = below[1:] if below and below[0].isdigit() else below
            return name, "/".join(below).removeprefix("files/")
        raise PackageError(f"{uri} is on another machine")
    return "", ""


def model_file(files: Files, path: str) -> str:
    """Returns the SDF file of what an `<include>` names: the file, or the newest one of a model's folder."""
    if files.read(path) is not None:
        return path
    manifest = files.read(posixpath.join(path, _MANIFEST))
    best, chosen = (-1, -1), "model.sdf"
    if manifest is not None and manifest_name(manifest) is not None:
        import xml.etree.ElementTree as ET  # noqa: PLC0415 - `manifest_name` has parsed it before

        for element in ET.fromstring(manifest).findall("sdf"):  # noqa: S314 - without a DOCTYPE
            words = (element.get("version") or "1.0").strip().split(".")
            version = (
                (int(words[0]), int(words[1])) if len(words) == 2 and all(map(str.isdigit, words)) else (0, 0)
            )
            if best < version <= NEWEST and (element.text or "").strip():
                best, chosen = version, (element.text or "").strip()
    return posixpath.join(path, chosen)
