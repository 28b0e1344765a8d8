"""Translates addresses of files in messages: `file:///project/…` for the page, real paths for the server.

The page must neither learn where its files are on this machine nor name any other file: addresses that leave
the project are refused. Addresses of the server outside the project (a library's source) become
`file:///library/…`, which the page shows but cannot open.
"""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Any, Final
from urllib.parse import quote, unquote

PROJECT: Final = "file:///project"
LIBRARY: Final = "file:///library"
_KEYS: Final = frozenset({"uri", "targetUri", "rootUri", "oldUri", "newUri", "baseUri"})
_MAX_DEPTH: Final = 64
_MARKERS: Final = ("site-packages/", "typeshed/", "library/", "lib/python3.11/")


class ForeignAddressError(ValueError):
    """The page named a file outside of its project."""


class Addresses:
    """Translates the paths in messages about one folder.

    Args:
        root: the absolute path of the folder that holds the project's files.
    """

    def __init__(self, root: str) -> None:
        self._root = "file://" + quote(root.rstrip("/"))
        self._plain = root.rstrip("/")

    def inward(self, message: Any) -> Any:
        """Translates a message of the page for the server.

        Raises:
            ForeignAddressError: the message names a file outside the project, or is nested too deeply.
        """
        return _mapped(message, self._real, 0)

    def outward(self, message: Any) -> Any:
        """Translates a message of the server for the page."""
        return _mapped(message, self._shown, 0)

    def hidden(self, text: str) -> str:
        """Returns a text for the user without the path of the folder."""
        return text.replace(self._plain + "/", "")

    def _real(self, uri: str) -> str:
        if uri == PROJECT:
            return self._root
        path = unquote(uri.removeprefix(PROJECT + "/"))
        parts = PurePosixPath(path).parts
        is_inside = parts and ".." not in parts and not path.startswith("/") and "\0" not in path
        if not uri.startswith(PROJECT + "/") or not is_inside:
            raise ForeignAddressError(f"“{uri[:200]}” is not a file of this project.")
        return f"{self._root}/{quote(path)}"

    def _shown(self, uri: str) -> str:
        if uri == self._root or uri.startswith(self._root + "/"):
            return PROJECT + uri[len(self._root) :]
        path = unquote(uri)
        for marker in _MARKERS:
            before, found, after = path.rpartition(marker)
            if found and before:
                return f"{LIBRARY}/{quote(after)}"
        return f"{LIBRARY}/{quote(PurePosixPath(path).name)}"


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
