"""The rules for names of projects and files.

Users may choose names in any script. Names are refused if some file system, zip tool, browser or ROS tool
would misread them: control and invisible characters, device names, trailing dots and spaces, paths with `..`,
and two names that differ only in case or in Unicode form.
"""

from __future__ import annotations

import re
import unicodedata
from typing import Final

from backend.core.problems import InvalidInputError

MAX_NAME_LENGTH: Final = 100
MAX_SEGMENT_BYTES: Final = 200
MAX_PATH_LENGTH: Final = 400
MAX_DEPTH: Final = 16

_DEVICES: Final = frozenset(
    ["con", "prn", "aux", "nul", *(f"{stem}{digit}" for stem in ("com", "lpt") for digit in "123456789")]
)
_FORBIDDEN_IN_PATH: Final = re.compile(r'[\\:*?"<>|]')
_INVISIBLE: Final = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})
_JOINERS: Final = frozenset("\u200c\u200d")  # invisible, but required in several scripts


def key(name: str) -> str:
    """Returns a key that is equal for names that a person or some file system would confuse."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFKC", name).casefold())


def project_name(name: str, *, field: str = "name") -> str:
    """Returns the name of a project in the form that is stored.

    Raises:
        InvalidInputError: the name is not valid for a project.
    """
    clean = unicodedata.normalize("NFC", name).strip()
    if not clean:
        raise InvalidInputError("A project needs a name.", hint="Type at least one letter.", field=field)
    if len(clean) > MAX_NAME_LENGTH:
        raise InvalidInputError(f"A name has at most {MAX_NAME_LENGTH} characters.", field=field)
    if bad := _unprintable(clean):
        raise InvalidInputError(f"The name contains the invisible character {bad}.", field=field)
    if clean.strip(".") == "" or "/" in clean or "\\" in clean:
        raise InvalidInputError(
            "A project's name is no path: it holds no slash and is not just dots.", field=field
        )
    if len(key(clean)) > 4 * MAX_NAME_LENGTH:
        raise InvalidInputError("The name is too long.", field=field)
    return clean


def file_path(path: str, *, field: str = "path") -> str:
    """Returns the path in the form that is stored: relative, with `/`, in NFC.

    Raises:
        InvalidInputError: the path is not valid for a file of a project.
    """
    clean = unicodedata.normalize("NFC", path)
    if not clean:
        raise InvalidInputError("A file needs a path.", field=field)
    if clean.startswith("/"):
        raise InvalidInputError(
            f"“{shown(clean)}” is absolute; paths are relative to the project.", field=field
        )
    segments = clean.split("/")
    if len(clean) > MAX_PATH_LENGTH or len(key(clean)) > 4 * MAX_PATH_LENGTH or len(segments) > MAX_DEPTH:
        raise InvalidInputError(
            f"A path has at most {MAX_PATH_LENGTH} characters and {MAX_DEPTH} levels.", field=field
        )
    for segment in segments:
        if complaint := _segment_complaint(segment):
            raise InvalidInputError(f"“{shown(clean)}” cannot be a path: {complaint}.", field=field)
    return clean


def writable_path(path: str, *, field: str = "path") -> str:
    """Returns the path of a file to write, in the form that is stored.

    Raises:
        InvalidInputError: the path is invalid, or is inside of a folder of a tool.
    """
    clean = file_path(path, field=field)
    if is_of_tool(clean):
        raise InvalidInputError(
            f"“{shown(clean)}” cannot be written: folders that begin with a dot are for tools, which run "
            "what they say.",
            hint="Choose a folder without a dot before its name.",
            field=field,
        )
    return clean


def is_of_tool(path: str) -> bool:
    """Returns whether a file belongs to a tool, such as `.git/config`; the translator defines the rule."""
    from translator.foreign import is_of_tool as rule  # noqa: PLC0415 - keeps the start of the server short

    return rule(path)


def _segment_complaint(segment: str) -> str:  # noqa: PLR0911 - one return a rule
    if segment in {"", ".", ".."}:
        return "a part of it is empty, “.” or “..”"
    if bad := _unprintable(segment):
        return f"it contains the invisible character {bad}"
    if found := _FORBIDDEN_IN_PATH.search(segment):
        return f"it contains {found.group()}"
    if segment != segment.strip(" ") or segment.endswith("."):
        return "a part of it begins or ends with a space, or ends with a dot"
    if key(segment).partition(".")[0].rstrip() in _DEVICES:
        return "a part of it is the name of a device on Windows"
    if len(segment.encode()) > MAX_SEGMENT_BYTES:
        return "a part of it is too long"
    return ""


def _unprintable(text: str) -> str:
    for character in text:
        if unicodedata.category(character) in _INVISIBLE and character not in _JOINERS:
            return f"U+{ord(character):04X}"
    return ""


def shown(text: str) -> str:
    """Returns text of a user in a form that is safe and short enough for a message."""
    visible = "".join(c if unicodedata.category(c) not in _INVISIBLE else "�" for c in text)
    return visible if len(visible) <= 80 else visible[:77] + "…"


def free_name(wanted: str, taken: set[str]) -> str:
    """Returns the wanted name, or the first of `wanted 2`, `wanted 3` … whose key is not taken."""
    number = 1
    candidate = wanted
    while key(candidate) in taken:
        number += 1
        suffix = f" {number}"
        candidate = wanted[: MAX_NAME_LENGTH - len(suffix)].rstrip() + suffix
    return candidate
