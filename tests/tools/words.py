"""Checks the list of words (`words.toml`) in docstrings, comments, texts, docs and names of tests.

`python -m tests.tools.words` checks what is clean so far, and is a part of `make lint`.
`python -m tests.tools.words PATH …` checks other files or folders, to clean them.
"""

from __future__ import annotations

import ast
import io
import json
import re
import sys
import tokenize
import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

ROOT: Final = Path(__file__).resolve().parents[2]
LIST: Final = Path(__file__).with_name("words.toml")
BEHAVIOUR_TESTS: Final = ".test.yaml"
FOLDERS_LEFT_OUT: Final = {"node_modules", "__pycache__", "dist", "locales"}
# Spans that are not our own prose; their replacement keeps the line breaks.
QUOTED: Final = re.compile(r"```.*?```|``[^`]*``|`[^`]*`|“[^”]*”|„[^“]*“|«[^»]*»", re.DOTALL)
BLOCK_QUOTE: Final = re.compile(r"^\s*>.*$", re.MULTILINE)
SCRIPT_COMMENT: Final = re.compile(r"/\*.*?\*/|(?<![:\w'\"`/])//[^\n]*", re.DOTALL)
SCRIPT_TEST: Final = re.compile(
    r"\b(?:it|test|describe)(?:\.\w+)*(?:\([^)]*\))?\(\s*(['\"`])(.*?)\1", re.DOTALL
)
JSON_VALUE: Final = re.compile(r'(?:[:\[,]|^)\s*("(?:[^"\\\n]|\\.)*")(?!\s*:)', re.MULTILINE)
HASH_COMMENT: Final = re.compile(r"(?<!\S)#[^\n]*")
DOCUMENTED: Final = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


class Text(NamedTuple):
    """A piece of prose, with the line where it begins."""

    line: int
    text: str
    is_docstring: bool = False


class Finding(NamedTuple):
    """A word that is on the list."""

    line: int
    word: str
    preferred: str


class Words(NamedTuple):
    """The list, compiled."""

    clean: list[str]
    skipped: list[str]
    words: list[tuple[re.Pattern[str], str]]
    # Matches where any of the words does: most pieces of prose hold none.
    any_word: re.Pattern[str]
    openings: dict[str, str]


def read_list(path: Path = LIST) -> Words:
    """Reads `words.toml`."""
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    words = [
        (re.compile(r"\b(?:" + words.replace(" ", r"\s+") + r")\b", re.IGNORECASE), preferred)
        for words, preferred in table["words"].items()
    ]
    any_word = re.compile("|".join(pattern.pattern for pattern, _ in words), re.IGNORECASE)
    return Words(table["clean"], table["skipped"], words, any_word, table["openings"])


def find(texts: Iterator[Text], words: Words) -> Iterator[Finding]:
    """Yields each word of the list that is used outside of quotations."""
    for piece in texts:
        prose = BLOCK_QUOTE.sub(_blank, QUOTED.sub(_blank, piece.text))
        for pattern, preferred in words.words if words.any_word.search(prose) else ():
            for match in pattern.finditer(prose):
                line = piece.line + prose.count("\n", 0, match.start())
                yield Finding(line, " ".join(match[0].split()), preferred)
        first = piece.text.split(maxsplit=1)[0] if piece.is_docstring and piece.text.strip() else ""
        if first in words.openings:
            yield Finding(piece.line, f"{first} …", words.openings[first])


def _blank(match: re.Match[str]) -> str:
    return re.sub(r"\S", "·", match[0])


def python_texts(source: str) -> Iterator[Text]:
    """Yields docstrings, comments, texts of several words, and the names of tests."""
    tree = ast.parse(source)
    docstrings = set()
    for node in ast.walk(tree):
        first = node.body[0] if isinstance(node, DOCUMENTED) and node.body else None
        value = first.value if isinstance(first, ast.Expr) else None
        if isinstance(value, ast.Constant) and isinstance(value.value, str):
            docstrings.add(id(value))
            yield Text(value.lineno, value.value, is_docstring=True)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name.startswith("test_"):
            yield Text(node.lineno, node.name.replace("_", " "))
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            yield from [Text(node.lineno, node.value)] if _is_prose(node.value) else []
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            yield Text(token.start[0], token.string)


def _is_prose(text: str) -> bool:
    return text.count(" ") > 1 and not text.lstrip().startswith(("<", "{"))


def script_texts(source: str) -> Iterator[Text]:
    """Yields the comments of TypeScript and CSS, and the names of tests."""
    for match in SCRIPT_COMMENT.finditer(source):
        yield Text(source.count("\n", 0, match.start()) + 1, match[0])
    for match in SCRIPT_TEST.finditer(source):
        yield Text(source.count("\n", 0, match.start()) + 1, match[2])


def json_texts(source: str) -> Iterator[Text]:
    """Yields every string of a table of texts."""
    for match in JSON_VALUE.finditer(source):
        yield Text(source.count("\n", 0, match.start()) + 1, str(json.loads(match[1])))


def markdown_texts(source: str) -> Iterator[Text]:
    """Yields the whole page; `find` skips code and quotations."""
    yield Text(1, source)


def hash_texts(source: str) -> Iterator[Text]:
    """Yields the comments of shell scripts, YAML, TOML, Makefiles and Dockerfiles."""
    for number, line in enumerate(source.splitlines(), start=1):
        for comment in HASH_COMMENT.findall(line):
            yield Text(number, comment)


READERS: Final[dict[str, Callable[[str], Iterator[Text]]]] = {
    ".py": python_texts,
    ".j2": markdown_texts,
    ".ts": script_texts,
    ".tsx": script_texts,
    ".mjs": script_texts,
    ".css": script_texts,
    ".json": json_texts,
    ".md": markdown_texts,
    ".sh": hash_texts,
    ".yaml": hash_texts,
    ".yml": hash_texts,
    ".toml": hash_texts,
    ".Dockerfile": hash_texts,
    "Makefile": hash_texts,
}


def reader(path: Path) -> Callable[[str], Iterator[Text]] | None:
    """Returns the function that reads such a file, or None where it holds no prose of ours."""
    if path.name.endswith(BEHAVIOUR_TESTS):
        return markdown_texts  # the names of the tests are shown to users
    return READERS.get(path.suffix) or READERS.get(path.name)


def files(names: list[str], words: Words) -> Iterator[Path]:
    """Yields the files to check among files and folders, without those that are never checked."""
    for name in names:
        top = ROOT / name
        if not top.exists():
            raise SystemExit(f"{LIST.name}: there is no {name}; `clean` names files and folders that exist")
        for path in [top] if top.is_file() else sorted(top.rglob("*")):
            # A file that is named explicitly is always checked, for example the English texts of the page.
            inner = path.relative_to(top).parts
            is_prose = path.is_file() and reader(path) is not None and not FOLDERS_LEFT_OUT & set(inner)
            if is_prose and not _is_skipped(path.relative_to(ROOT), words):
                yield path


def _is_skipped(path: Path, words: Words) -> bool:
    return any(path.match(skipped) or path.is_relative_to(skipped) for skipped in words.skipped)


def main(arguments: list[str]) -> int:
    """Prints each finding with its place; returns 1 if there are any."""
    words = read_list()
    count = 0
    for path in files(arguments or words.clean, words):
        read = reader(path)
        if read is None:
            continue
        for finding in sorted(find(read(path.read_text(encoding="utf-8")), words)):
            count += 1
            where = f"{path.relative_to(ROOT)}:{finding.line}"
            print(f"{where}: “{finding.word}”: write {finding.preferred}")
    if count:
        print(f"{count} words of the list `tests/tools/words.toml`")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
