"""Checks the documents: pages short enough to be read, and links that lead somewhere.

A page of `docs/`, and README and CONTRIBUTING, have at most 1,500 words of prose; tables, code and pages
that a program writes do not count. Every link to a file of the repository, and to a heading in it, must
exist; links of `docs/` stay within it, since the documentation site is built from it alone.
`python -m tests.tools.pages` is a part of `make lint`.
"""

from __future__ import annotations

import re
import sys
from functools import cache
from pathlib import Path
from typing import Final
from urllib.parse import unquote

ROOT: Final = Path(__file__).resolve().parents[2]
DOCS: Final = ROOT / "docs"
MOST_WORDS: Final = 1500
# What a page that a program writes says of itself.
GENERATED: Final = re.compile(r"^<!-- (?:Generated|Written) by ", re.MULTILINE)
FENCE: Final = re.compile(
    r"^(?P<indent> *)(?P<fence>```+|~~~+).*?^(?P=indent)(?P=fence)[ \t]*$", re.DOTALL | re.MULTILINE
)
INDENTED: Final = re.compile(r"(?:^|(?<=\n\n))(?: {4}[^\n]*\n)+")
TABLE: Final = re.compile(r"^ *\|.*$", re.MULTILINE)
COMMENT: Final = re.compile(r"<!--.*?-->", re.DOTALL)
SPAN: Final = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.DOTALL)
LINK: Final = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
TARGET: Final = re.compile(r"(?<=\])\([^)\s]*\)")
HEADING: Final = re.compile(r"^#{1,6} +(.+?) *#*$", re.MULTILINE)
NAMED: Final = re.compile(r"<(?:a|span|div)[^>]* (?:id|name)=\"([^\"]+)\"")
OUTSIDE: Final = re.compile(r"[a-z][a-z0-9+.-]*:|//")


def documents() -> list[Path]:
    """Returns the documents of the repository, with its first pages."""
    first = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", ".github/SECURITY.md")]
    return [*first, *sorted(DOCS.rglob("*.md"))]


def without_code(text: str) -> str:
    """Returns a page without code that stands alone and without comments, line by line where it was."""

    def blank(found: re.Match[str]) -> str:
        return "\n" * found.group().count("\n")

    return COMMENT.sub(blank, INDENTED.sub(blank, FENCE.sub(blank, text)))


def words_of_prose(text: str) -> int:
    """Counts the words of a page that are neither code nor table; a span of code is one word."""
    prose = TABLE.sub("", without_code(text))
    prose = TARGET.sub("", SPAN.sub("code", prose))
    return len([word for word in prose.split() if any(letter.isalnum() for letter in word)])


def anchor(heading: str) -> str:
    """Returns the address of a heading as GitHub and the site make it."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
    return re.sub(r"[^\w\- ]", "", plain.strip().lower()).replace(" ", "-")


@cache
def anchors(page: Path) -> frozenset[str]:
    """Returns the addresses within a page; a heading that is there again gets a number."""
    text = page.read_text(encoding="utf-8")
    found: set[str] = set(NAMED.findall(text))
    for heading in HEADING.findall(without_code(text)):
        name = anchor(heading)
        same = 0
        while (numbered := f"{name}-{same}" if same else name) in found:
            same += 1
        found.add(numbered)
    return frozenset(found)


def problem(page: Path, link: str) -> str | None:
    """Returns what is wrong with a link of a page; None if it leads somewhere."""
    if OUTSIDE.match(link):
        return None
    path, _, name = unquote(link).partition("#")
    target = (page.parent / path).resolve() if path else page
    if not target.is_relative_to(ROOT) or not target.exists():
        return f"links to `{link}`, which does not exist"
    if target.is_dir():
        return f"links to `{link}`, a folder, which the site has no page of"
    if page.is_relative_to(DOCS) and not target.is_relative_to(DOCS):
        return f"links to `{link}`, which the site does not have: name the path in `code` instead"
    if name and target.suffix == ".md" and name not in anchors(target):
        return f"links to `{link}`, but no heading there has this address"
    return None


def findings(page: Path) -> list[str]:
    """Returns what is wrong with a page, each with its place."""
    text = page.read_text(encoding="utf-8")
    shown = page.relative_to(ROOT) if page.is_relative_to(ROOT) else page
    found = []
    count = words_of_prose(text)
    if count > MOST_WORDS and not GENERATED.search(text):
        found.append(
            f"{shown}: {count} words of prose, of {MOST_WORDS} at most: divide it by what a reader asks"
        )
    for number, line in enumerate(without_code(text).splitlines(), 1):
        for link in LINK.findall(SPAN.sub("", line)):
            if reason := problem(page, link):
                found.append(f"{shown}:{number}: {reason}")
    return found


def main(names: list[str]) -> int:
    """Prints what is wrong with the named pages, or with all of them."""
    pages = [Path(name).resolve() for name in names] or documents()
    found = [finding for page in pages for finding in findings(page)]
    for finding in found:
        print(finding)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
