"""Chooses the tests of `make test`: cheap ones, the core, dear ones that changed, a tenth of the others."""

from __future__ import annotations

import hashlib
import json
import math
import tomllib
from dataclasses import dataclass
from enum import StrEnum
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Final

from tests.tools.selection.table import ROOT, TableError, file_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from pathlib import Path

    from tests.tools.selection.table import Table

CORE: Final = ROOT / "tests" / "core.toml"
SAMPLED_SHARE: Final = 0.1


class Reason(StrEnum):
    """Why a dear test runs, or does not."""

    CORE = "core"
    CHANGED = "changed"
    SAMPLED = "sampled"
    LEFT_OUT = "left out"


@dataclass(frozen=True)
class Selection:
    """The reason of each dear test; all other tests run. `sample` repeats the draw."""

    reasons: dict[str, Reason]
    sample: str

    def tests(self, reason: Reason) -> list[str]:
        """Returns the tests with a reason."""
        return [test for test, each in self.reasons.items() if each is reason]

    def save(self, path: Path) -> None:
        """Writes it for the processes of pytest."""
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps({"sample": self.sample, "reasons": self.reasons}), encoding="utf-8")

    @staticmethod
    def load(path: Path) -> Selection:
        """Reads what `save` wrote."""
        stored = json.loads(path.read_text(encoding="utf-8"))
        return Selection({test: Reason(each) for test, each in stored["reasons"].items()}, stored["sample"])


def choose(
    table: Table, is_core: Callable[[str], bool], changed: Callable[[str], bool], sample: str
) -> Selection:
    """Chooses among the dear tests; `changed` says of a test file whether its inputs changed."""
    reasons: dict[str, Reason] = {}
    files: dict[str, bool] = {}
    for test in sorted(table.dear()):
        file = file_of(test)
        if is_core(test):
            reasons[test] = Reason.CORE
        elif files[file] if file in files else files.setdefault(file, changed(file)):
            reasons[test] = Reason.CHANGED
        else:
            reasons[test] = Reason.LEFT_OUT
    left_out = [test for test, reason in reasons.items() if reason is Reason.LEFT_OUT]
    for test in drawn(left_out, sample):
        reasons[test] = Reason.SAMPLED
    return Selection(reasons, sample)


def drawn(tests: Iterable[str], sample: str) -> list[str]:
    """Returns a tenth of some tests, rounded up, by a draw that `sample` repeats."""
    ordered = sorted(tests, key=lambda test: hashlib.sha256(f"{sample} {test}".encode()).digest())
    return ordered[: math.ceil(SAMPLED_SHARE * len(ordered))]


def core_patterns(path: Path = CORE) -> dict[str, list[str]]:
    """Returns the patterns of the core's tests by their headings.

    Raises:
        TableError: the file is missing or has another form.
    """
    try:
        parts: Mapping[str, object] = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise TableError(f"{path.name} cannot be read: {error}") from None
    found: dict[str, list[str]] = {}
    for heading, patterns in parts.items():
        if not isinstance(patterns, list) or not all(isinstance(each, str) for each in patterns):
            raise TableError(f"{path.name}: [{heading}] is a list of tests")
        found[heading] = patterns
    return found


def matches(test: str, pattern: str) -> bool:
    """Returns whether a test is meant by a pattern: a file, a test, or with `*` many of them."""
    return (
        test == pattern
        or test.startswith((f"{pattern}::", f"{pattern}["))
        or fnmatchcase(test, _literal(pattern))
    )


def _literal(pattern: str) -> str:
    return pattern.replace("[", "[[]")


def core_of(patterns: Mapping[str, list[str]]) -> Callable[[str], bool]:
    """Returns whether a test belongs to the core."""
    every = [pattern for heading in patterns.values() for pattern in heading]
    return lambda test: any(matches(test, pattern) for pattern in every)
