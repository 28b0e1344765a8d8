"""Translates addresses of files in messages: `file:///project/…` for the page, real paths for the server.

The page must neither learn where its files are on this machine nor name any other file: addresses that leave
the project are refused. Sources that may be read (`sources.py`) become `file:///library/<label>/…`; the page
opens them read-only. All other addresses of the server become `file:///elsewhere/<name>`, only to be shown.
"""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any, Final
from urllib.parse import quote, unquote

if TYPE_CHECKING:
    from collections.abc import Mapping

PROJECT: Final = "file:///project"
LIBRARY: Final = "file:///library"
ELSEWHERE: Final = "file:///elsewhere"
_KEYS: Final = frozenset({"uri", "targetUri", "rootUri", "oldUri", "newUri", "baseUri"})
_MAX_DEPTH: Final = 64


class ForeignAddressError(ValueError):
    """The page named a file that is neither of its project nor a readable source."""


class Addresses:
    """Translates the paths in messages about one folder.

    Args:
        root: the absolute path of the folder that holds the project's files.
        sources: the folders of sources that may be read, by label.
    """

    def __init__(self, root: str, sources: Mapping[str, str]) -> None:
        self._root = "file://" + quote(root.rstrip("/"))
        self._plain = root.rstrip("/")
        # The longest comes first, since one folder can be inside another.
        self._folders = sorted(((folder, label) for label, folder in sources.items()), key=_longest_first)
        self._labels = sorted(sources.items(), key=_longest_first)

    def inward(self, message: Any) -> Any:
        """Translates a message of the page for the server.

        Raises:
            ForeignAddressError: the message names a file outside the project, or is nested too deeply.
        """
        return _mapped(message, self._real, 0)

    def outward(self, message: Any) -> Any:
        """Translates a message of the server for the page."""
        return _mapped(message, self._shown, 0)

    def _real(self, uri: str) -> str:
        if uri == PROJECT:
            return self._root
        for shown, real in (
            (PROJECT, self._plain),
            *((f"{LIBRARY}/{label}", at) for label, at in self._labels),
        ):
            if uri.startswith(shown + "/"):
                return f"file://{quote(real)}/{quote(_inside(uri, unquote(uri[len(shown) + 1 :])))}"
        raise _foreign(uri)

    def _shown(self, uri: str) -> str:
        if uri == self._root or uri.startswith(self._root + "/"):
            return PROJECT + uri[len(self._root) :]
        path = unquote(uri.removeprefix("file://"))
        for folder, label in self._folders:
            if path.startswith(folder + "/"):
                return f"{LIBRARY}/{label}{quote(path[len(folder) :])}"
        return f"{ELSEWHERE}/{quote(PurePosixPath(path).name)}"


def path_of(uri: str) -> str:
    """Returns the path in an address that `inward` has translated."""
    return unquote(uri.removeprefix("file://"))


def _inside(uri: str, path: str) -> str:
    parts = PurePosixPath(path).parts
    if not parts or ".." in parts or path.startswith("/") or "\0" in path:
        raise _foreign(uri)
    return path


def _foreign(uri: str) -> ForeignAddressError:
    return ForeignAddressError(f"“{uri[:200]}” is not a file of this project.")


def _longest_first(pair: tuple[str, str]) -> int:
    return -len(pair[0])


def _mapped(value: Any, uri: Any, depth: int) -> Any:
    if depth > _MAX_DEPTH:
        raise ForeignAddressError("The message is nested too deeply.")
    if isinstance(value, list):
        return [_mapped(each, uri, depth + 1) for each in value]
    if not isinstance(value, dict):
        return value
    result = {}
    for key, each in value.items():
        if key in _KEYS and isinstance(each, str):
            result[key] = uri(each)
        elif key == "changes" and isinstance(each, dict):
            result[key] = {uri(name): _mapped(edits, uri, depth + 1) for name, edits in each.items()}
        else:
            result[key] = _mapped(each, uri, depth + 1)
    return result
