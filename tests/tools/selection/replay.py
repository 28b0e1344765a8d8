"""Lays the paths of past commits on today's tree, and chooses what `make test` would have run for each."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass
from statistics import median
from typing import TYPE_CHECKING, Final

from tests.tools.selection.choose import Reason, choose
from tests.tools.selection.inputs import Inputs
from tests.tools.selection.sources import of_commit
from tests.tools.selection.units import Unit, differences

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from tests.tools.selection.choose import Selection
    from tests.tools.selection.table import Table

PRODUCT: Final = ("backend/", "executor/", "translator/", "tree_gardener/", "frontend/src/")
PAGE_TESTS: Final = (".test.ts", ".test.tsx")


@dataclass(frozen=True)
class Change:
    """The paths that commits change, and the units of the modules among them, with those that went."""

    paths: frozenset[str]
    units: frozenset[tuple[str, Unit, bool]] = frozenset()
    """Each with the path, and whether only its docstrings differ."""

    def __or__(self, other: Change) -> Change:
        return Change(self.paths | other.paths, self.units | other.units)


class Replay:
    """Chooses for sets of changed paths."""

    def __init__(self, table: Table, inputs: Inputs, is_core: Callable[[str], bool]) -> None:
        self._table = table
        self._inputs = inputs
        self._is_core = is_core
        self._of = {file: inputs.of(file) for file in table.inputs}
        self._dear = table.dear()
        self.all_minutes = (sum(table.files.values()) + sum(table.lanes.values())) / 60
        """Processor minutes of all tests and checks."""

    def of(self, change: Change, sample: str) -> Selection:
        """Returns the selection for a change; unknown paths that are gone now count as read by all."""
        gone = {path for path in change.paths if path not in self._inputs.tree and _is_input(path)}
        return choose(
            self._table,
            self._is_core,
            lambda file: file not in self._of or bool(gone) or self._touches(change, file),
            sample,
        )

    def _touches(self, change: Change, file: str) -> bool:
        reached = self._inputs.reached(file)
        if reached is None:
            return not change.paths.isdisjoint(self._of[file])
        wholes = self._inputs.wholes(file) | {file}
        if not change.paths.isdisjoint(wholes):
            return True
        return any(
            self._inputs.whole_reach.counts(reached, path, unit)
            and (not has_only_docs or bool(reached.documented & {"", path}))
            for path, unit, has_only_docs in change.units
            if path in self._inputs.tree
        )

    def minutes(self, selection: Selection) -> float:
        """Returns the processor minutes of a selection, with the page's tests and all checks."""
        left_out = sum(self._dear[test] for test in selection.tests(Reason.LEFT_OUT))
        return self.all_minutes - left_out / 60

    @staticmethod
    def counts(selection: Selection) -> str:
        """Returns how many dear tests have each reason."""
        return ", ".join(f"{len(selection.tests(reason))} {reason}" for reason in Reason)


def _is_input(path: str) -> bool:
    """Returns whether a path that is gone counts: a change of a module's importers shows that it went."""
    return not path.endswith((".py", ".ts", ".tsx", ".md", ".json", ".css"))


def commits(root: Path, number: int) -> list[tuple[str, str]]:
    """Returns the newest commits with their subjects, the newest first, merges left out."""
    lines = _git(root, "log", "--no-merges", f"-{number}", "--format=%H %s").splitlines()
    return [(line[:40], line[41:]) for line in lines]


def changed_paths(root: Path, commit: str) -> frozenset[str]:
    """Returns the paths that a commit changes."""
    return frozenset(_git(root, "show", "--format=", "--name-only", "-z", commit).split("\0")) - {""}


def change_of(root: Path, commit: str) -> Change:
    """Returns what a commit changes."""
    paths = changed_paths(root, commit)
    units = {
        (path, unit, has_only_docs)
        for path in paths
        if Inputs.is_module(path)
        for unit, has_only_docs in differences(
            of_commit(root, f"{commit}~1", path), of_commit(root, commit, path)
        )
    }
    return Change(paths, frozenset(units))


def is_product(paths: frozenset[str]) -> bool:
    """Returns whether a change touches the product's code."""
    return any(path.startswith(PRODUCT) and not path.endswith(PAGE_TESTS) for path in paths)


def summary(minutes: Sequence[float], all_minutes: float) -> str:
    """Returns the median and the worst of the commits that changed product code, beside all tests."""
    if not minutes:
        return "no commit of these changes product code"
    middle, worst = median(minutes), max(minutes)
    return (
        f"{len(minutes)} commits of product code: median {middle:.1f} min ({middle / all_minutes:.2f} of all "
        f"{all_minutes:.1f}), worst {worst:.1f} ({worst / all_minutes:.2f}); processor time"
    )


def _git(root: Path, *arguments: str) -> str:
    return subprocess.run(["git", *arguments], cwd=root, check=True, capture_output=True, text=True).stdout
