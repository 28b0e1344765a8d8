"""Changes random lines of the product's Python, and runs the tests that execute them.

    python -m tests.tools.mutating.python [--count 150] [--seed 1] [--least 0.6] [--tests tests/translator …]

The lines are changed in a worktree of the last commit. The tests of a line are those that executed it (with
their processes), the cheap ones first, until one fails. A mutant is killed if that test passes without it; a
limit of time proves nothing. At the end stands which share of the killed ones `make test` kills: where the
change is new (its cheap and changed tests), and where it is old (cheap tests, core and sample alone).

Exit status 1: fewer mutants than `--least` were killed.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import subprocess
import sys
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Final, Protocol

from tests.benchmarks.beside.trees import Beside
from tests.tools.mutating.changes import Change, Mutant, changed, changes_of
from tests.tools.mutating.executed import Executed, executed
from tests.tools.selection import tree
from tests.tools.selection.choose import Reason, choose, core_of, core_patterns
from tests.tools.selection.inputs import Inputs, import_graph
from tests.tools.selection.table import ROOT, Table, file_of, read, read_loaded

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

PACKAGES: Final = ("translator", "tree_gardener", "executor", "backend")
PASSED_OVER: Final = ("backend/catalog/behaviours/", "migrations/")
LIMIT_S: Final = 300
REPORT: Final = ROOT / "var" / "mutants.jsonl"
_FAILED: Final = re.compile(r"^(?:FAILED|ERROR) (tests/\S+::.+?)(?: - |$)", re.MULTILINE)


@dataclass(frozen=True)
class Result:
    """The end of a mutant; `killer` is the test that saw it, empty if none did."""

    path: str
    line: int
    before: str
    after: str
    tests: int
    killer: str


@dataclass(frozen=True)
class Chances:
    """The tests that `make test` would run if a module is changed, and if it is not."""

    table: Table
    inputs: Inputs
    sample: str

    def runs(self, test: str, changed_path: str | None, /) -> bool:
        """Returns whether `make test` runs a test; all parameters of a function are one here."""
        selection = choose(
            self.table,
            core_of(core_patterns()),
            lambda file: changed_path is not None and changed_path in self.inputs.of(file),
            self.sample,
        )
        reasons = [reason for name, reason in selection.reasons.items() if name == test]
        return not reasons or reasons[0] is not Reason.LEFT_OUT


def chosen(root: Path, count: int, seed: int, sources: Iterable[str]) -> list[Mutant]:
    """Returns a mutant of each of `count` random lines; the same seed gives the same ones."""
    lines: dict[tuple[str, int], list[Change]] = {}
    texts = {path: (root / path).read_text(encoding="utf-8") for path in sources}
    for path, text in texts.items():
        for change in changes_of(text):
            lines.setdefault((path, change.line), []).append(change)
    chance = random.Random(seed)  # noqa: S311 - a sample, no secret
    found: list[Mutant] = []
    for path, line in chance.sample(sorted(lines), len(lines)):
        if len(found) == count:
            break
        if mutant := changed(path, texts[path], chance.choice(lines[path, line])):
            found.append(mutant)
    return found


def sources_of(files: Iterable[str]) -> list[str]:
    """Returns the product's modules among some paths."""
    return sorted(
        path
        for path in files
        if path.endswith(".py")
        and path.split("/")[0] in PACKAGES
        and not any(each in path for each in PASSED_OVER)
    )


class Copy:
    """A tree of the last commit, in which lines are changed one after the other."""

    def __init__(self, root: Path, python: Path) -> None:
        self.root = root
        self._python = python

    def killer(self, mutant: Mutant, tests: Sequence[str]) -> str:
        """Returns the first test that fails with a mutant and passes without it; empty if there is none."""
        file = self.root / mutant.path
        original = file.read_bytes()
        file.write_text(mutant.source, encoding="utf-8")
        try:
            failed = self._first_failure(tests)
        finally:
            file.write_bytes(original)
        return failed if failed and not self._first_failure([failed]) else ""

    def _first_failure(self, tests: Sequence[str]) -> str:
        options = ["-x", "-q", "-n0", "-p", "no:cacheprovider", "--tb=no", "-rfE"]
        try:
            done = subprocess.run(
                [self._python, "-m", "pytest", *options, *tests],
                cwd=self.root,
                capture_output=True,
                text=True,
                check=False,
                timeout=LIMIT_S,
            )
        except subprocess.TimeoutExpired:
            return ""
        found = _FAILED.search(done.stdout)
        return found[1] if found and "Timeout" not in done.stdout else ""


def candidates(mutant: Mutant, seen: Executed) -> frozenset[str]:
    """Returns the tests of a line; of one that is executed with its module, all tests of the module."""
    place = (mutant.path, mutant.line)
    if place in seen and not seen[place]:
        return frozenset().union(*(tests for (path, _), tests in seen.items() if path == mutant.path))
    return seen.get(place, frozenset())


def ordered(tests: Iterable[str], table: Table) -> list[str]:
    """Returns tests, those first that need little processor time."""
    cost: dict[str, float] = {}
    for name, each in table.tests.items():
        function = name.partition("[")[0]
        cost[function] = cost.get(function, 0.0) + each.median_s
    return sorted(tests, key=lambda test: (cost.get(test, 0.0), file_of(test), test))


class Chance(Protocol):
    """Knows what `make test` runs."""

    def runs(self, test: str, path: str | None, /) -> bool:
        """Returns whether a test runs where a path is changed, or none."""


def summary(results: Sequence[Result], chances: Chance) -> str:
    """Returns the last lines of the report."""
    killed = [result for result in results if result.killer]
    new = sum(chances.runs(result.killer, result.path) for result in killed)
    old = sum(chances.runs(result.killer, None) for result in killed)
    unseen = sum(not result.tests for result in results)
    return (
        f"{len(killed)} of {len(results)} killed ({len(killed) / max(1, len(results)):.0%}); "
        f"{unseen} are in lines that no test executes\n"
        f"of the killed ones `make test` kills {new / max(1, len(killed)):.0%} as a change, "
        f"and {old / max(1, len(killed)):.0%} where the mutant is in the base"
    )


def main(arguments: list[str] | None = None) -> int:
    """The command line; prints each mutant, and keeps the results in `var/mutants.jsonl`."""
    parser = argparse.ArgumentParser(prog="python -m tests.tools.mutating.python")
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--least", type=float, default=0.6, help="share that must be killed")
    parser.add_argument(
        "--packages", nargs="+", default=list(PACKAGES), help="folders whose lines are changed"
    )
    parser.add_argument("--tests", nargs="+", default=["tests"], help="the tests that may see a change")
    options = parser.parse_args(arguments)
    beside = Beside(ROOT, "HEAD")
    beside.build()
    own, table = beside.own(), read()
    files = tree.working_tree(own.folder)
    sources = [path for path in sources_of(files) if path.startswith(tuple(options.packages))]
    mutants = chosen(own.folder, options.count, options.seed, sources)
    print(f"{len(mutants)} lines, seed {options.seed}; first the tests run once, to see which execute them")
    seen = executed(
        own.folder, own.python, beside.kept / "coverage", {each.path for each in mutants}, options.tests
    )
    copy, results = Copy(own.folder, own.python), list[Result]()
    REPORT.parent.mkdir(exist_ok=True)
    with REPORT.open("w", encoding="utf-8") as report:
        for number, mutant in enumerate(mutants, start=1):
            tests = ordered(candidates(mutant, seen), table)
            killer = copy.killer(mutant, tests) if tests else ""
            results.append(Result(*mutant[:4], len(tests), killer))
            report.write(json.dumps(asdict(results[-1])) + "\n")
            report.flush()
            state = f"killed by {killer}" if killer else "SURVIVED" if tests else "NOT EXECUTED"
            print(f"{number:3} {mutant.path}:{mutant.line} {state}")
            print(f"      - {mutant.before}\n      + {mutant.after}", flush=True)
    print(summary(results, Chances(table, Inputs(files, import_graph(), read_loaded()), tree.digest(files))))
    killed = sum(bool(result.killer) for result in results)
    return 0 if killed >= options.least * len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
