"""Substitutions in launch files, as in ROS: `$(var name)`, `$(dirname)`, `$(env NAME default)`, packages.

Texts are read by the grammar of `launch`: arguments may be quoted and hold substitutions, and a backslash
takes the meaning of the character after it.
"""

from __future__ import annotations

import os
import re
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["SubstitutionError", "Substitutions", "has_substitutions", "truth"]

READ: Final = ("$(var …)", "$(dirname)", "$(env …)", "$(find-pkg-share …)", "$(find-pkg-prefix …)")
MOST_LEVELS: Final = 16
_TRUTHS: Final = {"true": True, "1": True, "false": False, "0": False}
_NAME: Final = re.compile(r"[A-Za-z][\w-]*")
_OPENED: Final = re.compile(r"(?<!\\)\$\(")


class SubstitutionError(ValueError):
    """A text cannot be replaced; the message says why."""


@dataclass(frozen=True)
class _Call:
    """One substitution: its name, and the parts of each argument."""

    name: str
    arguments: tuple[tuple[str | _Call, ...], ...]


@dataclass(frozen=True)
class Substitutions:
    """Replaces substitutions by the values of arguments; `folder` is that of the launch file."""

    variables: Mapping[str, str]
    folder: str

    def text(self, text: str) -> str:
        """Returns a text with its substitutions replaced.

        Raises:
            SubstitutionError: it cannot be read, or a substitution is not supported or has no value.
        """
        return self._joined(_parts(text))

    def words(self, text: str) -> list[str]:
        """Returns the words of a command line; what a substitution gives is never split.

        Raises:
            SubstitutionError: as `text`, or the words cannot be split.
        """
        words: list[str] = []
        word: list[str] = []  # the parts of the word that has no end yet

        def end() -> None:
            words.append("".join(word))
            word.clear()

        for part in _parts(text):
            if isinstance(part, _Call):
                word.append(self._value(part))
                continue
            try:
                found = shlex.split(part)
            except ValueError as error:
                why = "a quotation holds no substitution" if "quotation" in str(error) else str(error)
                raise SubstitutionError(f"{text!r} cannot be split into words: {why}") from error
            if word and part[0].isspace():
                end()
            for index, token in enumerate(found):
                if index:
                    end()
                word.append(token)
            if word and part[-1].isspace():
                end()
        if word:
            end()
        return words

    def _joined(self, parts: tuple[str | _Call, ...]) -> str:
        return "".join(self._value(part) if isinstance(part, _Call) else part for part in parts)

    def _value(self, call: _Call) -> str:
        name, given = call.name, [self._joined(parts) for parts in call.arguments]
        if name == "dirname":
            return self.folder
        if name == "optenv":
            raise SubstitutionError("$(optenv …) is of xacro; in launch files write $(env NAME '')")
        if name in {"var", "env"}:
            return self._variable(name, given)
        if name in {"find-pkg-share", "find-pkg-prefix"}:
            return _package(name, given[0] if given else "")
        raise SubstitutionError(f"$({name} …) is not read here; {', '.join(READ)} are")

    def _variable(self, kind: str, given: list[str]) -> str:
        if not 1 <= len(given) <= 2:
            raise SubstitutionError(f"$({kind} …) has a name, and perhaps a default")
        values = self.variables if kind == "var" else os.environ
        if given[0] in values:
            return values[given[0]]
        if len(given) == 2:
            return given[1]
        if kind == "env":
            raise SubstitutionError(
                f"the variable {given[0]} is not set here, and $(env …) has no default; "
                f"write $(env {given[0]} VALUE)"
            )
        known = ", ".join(sorted(self.variables)) or "there are none"
        raise SubstitutionError(f"there is no argument {given[0]!r} with a value ({known})")


def has_substitutions(text: str) -> bool:
    """Returns whether a text has a substitution."""
    return _OPENED.search(text) is not None


def _parts(text: str) -> tuple[str | _Call, ...]:
    return _Parser(text).parts("")


class _Parser:
    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._level = 0

    def parts(self, ends: str) -> tuple[str | _Call, ...]:
        """Reads to one of the characters `ends`, or to the end of the text."""
        found: list[str | _Call] = []
        while (char := self._peek()) and char not in ends:
            if self._text.startswith("$(", self._at):
                found.append(self._call())
                continue
            if char == "\\" and self._at + 1 < len(self._text):
                self._at += 1
                char = self._peek()
            self._at += 1
            if found and isinstance(found[-1], str):
                found[-1] += char
            else:
                found.append(char)
        return tuple(found)

    def _peek(self) -> str:
        return self._text[self._at : self._at + 1]

    def _call(self) -> _Call:
        self._level += 1
        begin = self._at
        name = _NAME.match(self._text, begin + 2)
        if name is None or self._level > MOST_LEVELS:
            why = "has no name" if name is None else f"is nested deeper than {MOST_LEVELS}"
            raise SubstitutionError(f"the substitution {self._text[begin : begin + 20]!r} {why}")
        self._at = name.end()
        arguments: list[tuple[str | _Call, ...]] = []
        while self._peek() != ")":
            if not self._peek():
                raise SubstitutionError(f"{self._text[begin:]!r} has no closing bracket")
            if self._peek() == " ":
                self._at += 1
                continue
            arguments.append(self._argument())
        self._at += 1
        self._level -= 1
        return _Call(name[0], tuple(arguments))

    def _argument(self) -> tuple[str | _Call, ...]:
        quote = self._peek()
        if quote not in "'\"":
            return self.parts(" )")
        self._at += 1
        found = self.parts(quote)
        if not self._peek():
            raise SubstitutionError(f"{self._text!r} cannot be split: a quotation has no end")
        self._at += 1
        return found


def _package(name: str, package: str) -> str:
    """Returns the folder of a package of the workspace that is sourced."""
    prefixes = [
        Path(prefix) for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if prefix
    ]
    for prefix in prefixes:
        share = prefix / "share" / package
        if package and share.is_dir():
            return str(share if name == "find-pkg-share" else prefix)
    where = ", ".join(map(str, prefixes)) or "no ROS workspace is sourced here"
    raise SubstitutionError(f"there is no package {package!r} ({where})")


def truth(text: str) -> bool:
    """Returns the truth value of a condition's text.

    Raises:
        SubstitutionError: it is neither true nor false.
    """
    value = _TRUTHS.get(text.strip().lower())
    if value is None:
        raise SubstitutionError(f"{text!r} is neither true nor false")
    return value
