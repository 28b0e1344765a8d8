"""Changes random lines of the page's features, and counts how many changes vitest notices.

    python -m tests.tools.mutating.page [--count 150] [--seed 1] [--least 0.6] [--folder src/features]

Each line is changed in a copy of the front end, so that the working tree stays untouched. Vitest runs the
tests that reach the changed module, and has 90 s: a mutant counts as killed if a test fails in that time. A
run that ends by the limit proves nothing, and counts as survived. Exit status 1: fewer mutants than `--least`
were killed; 2: the tests fail without any change. Part of `make mutants`.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT: Final = Path(__file__).resolve().parents[3]
LIMIT_S: Final = 90
BASELINE_S: Final = 1200
NO_TESTS: Final = "No test files found"
# The pattern that is searched in a line, and its replacement in the mutant. All keep the syntax valid.
CHANGES: Final[tuple[tuple[re.Pattern[str], str], ...]] = tuple(
    (re.compile(search), replacement)
    for search, replacement in (
        (r"===", "!=="),
        (r"!==", "==="),
        (r" && ", " || "),
        (r" \|\| ", " && "),
        (r" \?\? ", " && "),
        (r" < ", " >= "),
        (r" > ", " <= "),
        (r" >= ", " < "),
        (r" <= ", " > "),
        (r" \+ ", " - "),
        (r" - ", " + "),
        (r"(?<!['\"])\btrue\b", "false"),
        (r"(?<!['\"])\bfalse\b", "true"),
        (r"\bif \(", "if (!("),
        (r"(?<![\w.'#-])(\d+)(?![\w.'%-])", r"(\1 + 1)"),
        (r"(?<=[(=,] )'([^']+)'", r"'\1 changed'"),
        (r"^(\s*)(?:void )?[\w.]+\(.*\);$", r"\1;"),
        (r"^(\s*)return (?![(]$).+;$", r"\1return undefined as never;"),
    )
)
# Lines without behaviour: imports, types, comments, style classes.
PASSED_OVER: Final = re.compile(r"^\s*(?:import|export type|type|interface|//|\*|/\*)|className=|from '")


class Mutant(NamedTuple):
    """One changed line; `path` is relative to the front end, `line` counts from 1."""

    path: Path
    line: int
    before: str
    after: str


def mutants_of(path: Path, source: str) -> Iterator[Mutant]:
    """Yields every change of every line."""
    for number, line in enumerate(source.splitlines(), start=1):
        if PASSED_OVER.search(line):
            continue
        for search, replacement in CHANGES:
            changed = search.sub(replacement, line, count=1)
            if changed != line and (closed := _closed(changed)) is not None:
                yield Mutant(path, number, line, closed)


def _closed(line: str) -> str | None:
    """Closes the parenthesis that a negated condition opened; None where its end is on another line."""
    begin = line.find("if (!((")
    start = line.find("if (!(")
    if start < 0 or begin >= 0:
        return line if start < 0 else None
    depth = 0
    for index in range(start + 3, len(line)):
        depth += {"(": 1, ")": -1}.get(line[index], 0)
        if depth == 1 and line[index] == ")":
            return f"{line[:index]}){line[index:]}"
    return None


def chosen(folder: Path, count: int, seed: int) -> list[Mutant]:
    """Returns mutants of `count` random lines; the same seed gives the same ones."""
    lines: dict[tuple[Path, int], list[Mutant]] = {}
    for path in sorted(folder.rglob("*.ts*")):
        if ".test." not in path.name:
            for mutant in mutants_of(path, path.read_text(encoding="utf-8")):
                lines.setdefault((path, mutant.line), []).append(mutant)
    chance = random.Random(seed)  # noqa: S311 - a sample, no secret
    places = chance.sample(sorted(lines), min(count, len(lines)))
    return [chance.choice(lines[place]) for place in places]


def copied(folder: Path) -> Path:
    """Copies the front end into a folder beside links to all else of the repository; returns the copy."""
    for path in ROOT.iterdir():
        if path.name not in {"frontend", ".git", "var"}:
            (folder / path.name).symlink_to(path)
    copy = folder / "frontend"
    ignored = shutil.ignore_patterns("node_modules", "dist")
    shutil.copytree(ROOT / "frontend", copy, ignore=ignored)
    (copy / "node_modules").symlink_to((ROOT / "frontend" / "node_modules").resolve())
    return copy


def is_killed(frontend: Path, mutant: Mutant) -> bool:
    """Whether a test fails with the mutant in the copy of the front end."""
    file = frontend / mutant.path
    source = file.read_text(encoding="utf-8")
    lines = source.split("\n")
    lines[mutant.line - 1] = mutant.after
    file.write_text("\n".join(lines), encoding="utf-8")
    try:
        status, output = _run_tests(frontend, mutant.path)
    finally:
        file.write_text(source, encoding="utf-8")
    return status != 0 and NO_TESTS not in output


def _run_tests(frontend: Path, *paths: Path, limit_s: float = LIMIT_S) -> tuple[int, str]:
    """Runs the tests that reach some modules; status 0 also where the time is over."""
    options = ["--run", "--bail", "1", "--passWithNoTests"]
    command = ["node_modules/.bin/vitest", "related", *options, *map(str, paths)]
    process = subprocess.Popen(
        command,
        cwd=frontend,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,  # the workers end with it
    )
    try:
        output, _ = process.communicate(timeout=limit_s)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return 0, ""
    return process.returncode, output


def main(arguments: list[str] | None = None) -> int:
    """The command line; prints each mutant and the share of the killed ones."""
    parser = argparse.ArgumentParser(description="Changes random lines of the page and runs its tests.")
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--least", type=float, default=0.6, help="share that must be killed")
    parser.add_argument("--folder", default="src/features")
    options = parser.parse_args(arguments)
    killed = 0
    with tempfile.TemporaryDirectory(prefix="bt-studio-mutants-") as folder:
        frontend = copied(Path(folder))
        mutants = chosen(frontend / options.folder, options.count, options.seed)
        mutants = [mutant._replace(path=mutant.path.relative_to(frontend)) for mutant in mutants]
        status, output = _run_tests(frontend, *{mutant.path for mutant in mutants}, limit_s=BASELINE_S)
        if status != 0:
            print(output, "the tests fail without any change", sep="\n")
            return 2
        for number, mutant in enumerate(mutants, start=1):
            is_dead = is_killed(frontend, mutant)
            killed += is_dead
            state = "killed" if is_dead else "SURVIVED"
            place = f"{mutant.path}:{mutant.line}"
            print(f"{number:3} {state:8} {place}")
            print(f"      - {mutant.before.strip()}\n      + {mutant.after.strip()}", flush=True)
    share = killed / max(1, len(mutants))
    print(f"{killed} of {len(mutants)} killed ({share:.0%}), seed {options.seed}")
    return 0 if share >= options.least else 1


if __name__ == "__main__":
    sys.exit(main())
