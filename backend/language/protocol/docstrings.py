"""Documentation as the page shows it; does no I/O.

`ty` makes Markdown of docstrings in reST, Google and numpy style: sections of parameters, code, notes. What
it leaves as it is written is made readable here: roles of Sphinx, short section names, code that keeps the
indentation of its docstring. The authors are unknown, so length, indentation and nesting are bounded; the
page removes HTML.
"""

from __future__ import annotations

import re
import textwrap
from typing import Final

# More is never read in a card of 480 x 260, and the page's Markdown parser needs a quadratic time.
LIMIT: Final = 6000
_INDENT: Final = "&nbsp;"
_FENCE: Final = re.compile(r"\s*(`{3,})")
_BULLET: Final = re.compile(r"\s*[*+-] ")
# Deep indentation would leave a column of single letters; the parser overflows with nested quotes and lists.
_FAR: Final = re.compile(rf"(?:{_INDENT}){{17,}}")
_NESTED: Final = re.compile(r"(\s*(?:(?:[*+-]|\d{1,9}[.)])\s+|>\s?){4})(?=[*+>\d-])")
_ROLE: Final = re.compile(r"(?<![\w:`]):(?:[a-z][\w-]{0,30}:)?[a-z][\w-]{0,30}:`([^`\n]{1,300})`(?!`)")
_TITLED: Final = re.compile(r"([^<&]*[^<&\s])\s*(?:<|&lt;).*")
_PATH: Final = re.compile(r"(?<![\w`/])~(?:\w[\w\\]{0,80}\.){1,12}(\w[\w\\]{0,80})")
_SECTION: Final = re.compile(r"[A-Z][A-Za-z ]{1,30}:\s*")


def readable(markdown: str) -> str:
    """Returns the Markdown of a docstring without the marks that are meant for programs, and bounded."""
    if len(markdown) > LIMIT:
        markdown = markdown[:LIMIT].rsplit("\n", 1)[0].rstrip() + "\n\n…"
    shown: list[str] = []
    fence: list[str] = []
    for line in markdown.split("\n"):
        if fence:
            fence.append(line)
            if line.strip() == _fence_of(fence[0]):
                shown += _code(fence)
                fence = []
        elif _fence_of(line):
            fence = [line]
        else:
            shown.append(_prose(line))
    return "\n".join(_sections(shown + fence))


def _fence_of(line: str) -> str:
    found = _FENCE.match(line)
    return found.group(1) if found is not None else ""


def _code(lines: list[str]) -> list[str]:
    """Returns code without the indentation of its docstring; a list that was taken for code becomes one."""
    inside = textwrap.dedent("\n".join(lines[1:-1])).strip("\n").split("\n")
    if all(_BULLET.match(line) or not line.strip() for line in inside):
        return ["", *(_prose(line.strip()) for line in inside), ""]
    return [lines[0], *inside, lines[-1]]


def _prose(line: str) -> str:
    line = _ROLE.sub(lambda found: f"`{_named(found.group(1))}`", line)
    line = _FAR.sub(_INDENT * 16, _PATH.sub(r"\1", line))
    return _NESTED.sub(r"\1\\", line, count=1)


def _named(target: str) -> str:
    """Returns what is read of the target of a role: its title, or the last name of a path after a tilde."""
    titled = _TITLED.fullmatch(target)
    if titled is not None:
        return titled.group(1)
    return target.rpartition(".")[2] if target.startswith("~") else target.removeprefix("!")


def _sections(lines: list[str]) -> list[str]:
    """Marks the names of sections that `ty` does not know, such as `Note:` above indented lines."""
    return [
        f"**{line.strip()}**  " if _SECTION.fullmatch(line) and following.startswith(_INDENT) else line
        for line, following in zip(lines, [*lines[1:], ""], strict=True)
    ]
