"""Splits a script into tokens."""

import dataclasses
import re
from typing import Final

from tree_gardener.errors import ScriptError

OPERATORS: Final = (
    *(":=", "+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "&&", "||", ".."),
    *("=", "<", ">", "&", "|", "^", "+", "-", "*", "/", "!", "~", "?", ":", "(", ")", ";"),
)

_TOKEN = re.compile(
    r"(?P<blank>[ \t\r\n]+)"
    r"|(?P<real>[0-9]+(?:\.[0-9]+(?:[eE][+-]?[0-9]+)?|[eE][+-]?[0-9]+)(?![0-9A-Za-z_]))"
    r"|(?P<integer>(?:0[xX][0-9a-fA-F]+(?!\.)|[0-9]+)(?![0-9A-Za-z_]))"
    r"|(?P<string>'[^']*')"
    r"|(?P<name>[A-Za-z_@][A-Za-z0-9_]*)"
    rf"|(?P<operator>{'|'.join(map(re.escape, OPERATORS))})"
)
_BAD_NUMBER = re.compile(r"0[xX][0-9A-Za-z_.]*|[0-9][0-9A-Za-z_]*")

_HINTS: Final = {
    "%": "there is no remainder; there are + - * / & | ^ ..",
    '"': "strings are written in single quotes: 'text'",
    "'": "the string has no end; a quote cannot be part of a string",
    ".": "a number needs digits on both sides of its point: 0.5; '..' joins strings",
    ",": "one script has one value; separate statements by ';'",
    "{": "scripts use names without braces",
    "}": "scripts use names without braces",
}


@dataclasses.dataclass(frozen=True)
class Token:
    """A piece of a script: ``kind`` is integer, real, string, name, operator or end."""

    kind: str
    text: str
    start: int

    @property
    def end(self) -> int:
        """The offset after the last character."""
        return self.start + len(self.text)


def tokenize(text: str) -> list[Token]:
    """Splits a script into tokens; the last one is of kind ``end``.

    Raises:
        ScriptError: a character begins no token.
    """
    tokens = []
    position = 0
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            raise _unknown(text, position)
        kind = match.lastgroup or ""
        if kind != "blank":
            tokens.append(Token(kind, match.group(), position))
        position = match.end()
    tokens.append(Token("end", "", len(text)))
    return tokens


def _unknown(text: str, position: int) -> ScriptError:
    number = _BAD_NUMBER.match(text, position)
    if number is not None:
        hint = "names begin with a letter, '_' or '@'; numbers are 12, 0x1F, 1.5 or 1e3"
        return ScriptError((position, number.end()), f"'{number.group()}' is not a number", hint)
    character = text[position]
    hint = _HINTS.get(character, "names are made of the letters A-Z and a-z, digits, '_' and a leading '@'")
    return ScriptError((position, position + 1), f"'{character}' has no meaning here", hint)
