"""Counts the code of the product, by rooms: `python -m tests.tools.weight [--at REVISION] [FOLDER]`.

Counts are statements (of Python by `ast`, of TypeScript by its compiler) and the lines with code. Docstrings,
comments, blank lines, imports, generated files and migrations do not count. Tests, and what serves them
alone, are counted apart. With a folder, its own rooms are printed; with a revision, what is stored there.
"""

from __future__ import annotations

import argparse
import ast
import io
import json
import subprocess
import sys
import tarfile
import tempfile
import tokenize
from collections import Counter
from pathlib import Path, PurePosixPath
from typing import Final, NamedTuple

ROOT: Final = Path(__file__).resolve().parents[2]
TYPESCRIPT: Final = ROOT / "frontend" / "tools" / "weight.js"
PYTHON: Final = {".py", ".pyi"}
PAGE: Final = {".ts", ".tsx", ".js", ".mjs", ".cjs"}
LEFT_OUT: Final = {"migrations", "generated"}
# `tree_gardener/generated` writes Python; it is written by hand.
BY_HAND: Final = "tree_gardener/generated/"
TESTS: Final = ("tests/", "frontend/harness/", "frontend/vitest.setup.ts")
# What separates tokens, or is none.
LAYOUT: Final = {
    *(tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT),
    *(tokenize.ENCODING, tokenize.ENDMARKER),
}


class Weight(NamedTuple):
    """An amount of code."""

    statements: int = 0
    lines: int = 0

    def plus(self, other: Weight) -> Weight:
        """Returns the sum."""
        return Weight(self.statements + other.statements, self.lines + other.lines)


def weigh_python(source: str) -> Weight:
    """Returns the weight of a Python source."""
    tree = ast.parse(source)
    left_out: list[ast.stmt] = [
        node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)
    ]
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            left_out += [node.body[0]] if ast.get_docstring(node, clean=False) is not None else []
        elif isinstance(node, ast.If) and _serves_imports_alone(node):
            left_out.append(node)
    skipped = {line for node in left_out for line in range(node.lineno, (node.end_lineno or 0) + 1)}
    lines = {
        line
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type not in LAYOUT
        for line in range(token.start[0], token.end[0] + 1)
    }
    statements = sum(isinstance(node, ast.stmt) for node in ast.walk(tree)) - len(left_out)
    return Weight(statements, len(lines - skipped))


def _serves_imports_alone(node: ast.If) -> bool:
    return not node.orelse and all(isinstance(one, ast.Import | ast.ImportFrom) for one in node.body)


def weigh_page(paths: list[Path]) -> dict[Path, Weight]:
    """Returns the weight of each TypeScript source."""
    answer = subprocess.run(
        ["node", str(TYPESCRIPT)],
        input="\n".join(map(str, paths)),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    return {Path(path): Weight(*counts) for path, counts in json.loads(answer.stdout).items()}


def is_counted(name: str) -> bool:
    """Whether a file is code that somebody wrote for this version."""
    path = PurePosixPath(name)
    parts = path.parts[:-1]
    return path.suffix in PYTHON | PAGE and (name.startswith(BY_HAND) or not LEFT_OUT & set(parts))


def is_test(name: str) -> bool:
    """Whether a file serves tests alone."""
    return name.startswith(TESTS) or ".test." in PurePosixPath(name).name


def room_of(name: str, within: str = "") -> str:
    """Returns the folder two levels down, or one below `within`."""
    base = PurePosixPath(within).parts if within else ()
    depth = len(base) + 1 if within else 2
    folder = PurePosixPath(name).parts[:-1]
    # The sources of the page stand one level lower.
    return "/".join(folder[: max(depth, 3 if folder[:2] == ("frontend", "src") else 0)]) or "."


def weigh(root: Path, names: list[str]) -> dict[str, Weight]:
    """Returns the weight of each counted file, by its name below the root."""
    counted = [name for name in names if is_counted(name) and (root / name).is_file()]
    page = weigh_page([root / name for name in counted if PurePosixPath(name).suffix in PAGE])
    return {
        name: page.get(root / name) or weigh_python((root / name).read_text(encoding="utf-8"))
        for name in counted
    }


def _git(*arguments: str) -> bytes:
    return subprocess.run(["git", *arguments], cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout


def _weigh_at(revision: str | None) -> dict[str, Weight]:
    if revision is None:
        listed = _git("ls-files", "--cached", "--others", "--exclude-standard").decode().splitlines()
        return weigh(ROOT, sorted(set(listed)))
    with tempfile.TemporaryDirectory() as folder:
        with tarfile.open(fileobj=io.BytesIO(_git("archive", revision))) as archive:
            archive.extractall(folder, filter="data")
        return weigh(Path(folder), _git("ls-tree", "-r", "--name-only", revision).decode().splitlines())


def table(weights: dict[str, Weight], within: str = "") -> str:
    """Returns the rooms of product and tests, each with its weight, and the sums."""
    sums: dict[bool, Counter[str]] = {False: Counter(), True: Counter()}
    rooms: dict[tuple[bool, str], Weight] = {}
    for name, weight in weights.items():
        if within and not name.startswith(within.rstrip("/") + "/"):
            continue
        key = (is_test(name), room_of(name, within))
        rooms[key] = rooms.get(key, Weight()).plus(weight)
        sums[is_test(name)].update(weight._asdict())
    lines = [f"{'statements':>10} {'lines':>8}"]
    for tests, title in ((False, "the product"), (True, "tests")):
        found = sorted((room, weight) for (is_tests, room), weight in rooms.items() if is_tests == tests)
        lines += [f"{weight.statements:>10} {weight.lines:>8}  {room}" for room, weight in found]
        lines.append(f"{sums[tests]['statements']:>10} {sums[tests]['lines']:>8}  {title}\n")
    return "\n".join(lines).rstrip()


def main(arguments: list[str]) -> int:
    """Prints the table."""
    parser = argparse.ArgumentParser(prog="python -m tests.tools.weight", description=__doc__)
    parser.add_argument("--at", metavar="REVISION", help="a revision; without it, the working tree")
    parser.add_argument("folder", nargs="?", default="", help="a folder whose rooms are printed")
    options = parser.parse_args(arguments)
    print(table(_weigh_at(options.at), options.folder))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
