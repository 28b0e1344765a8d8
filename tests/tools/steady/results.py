"""Results of repeats in a file, a line each, and the report of what ever failed."""

from __future__ import annotations

import fcntl
import os
from collections import Counter, defaultdict
from typing import TYPE_CHECKING, Self

import msgspec

from tests.tools.steady.files import WrongInputError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable
    from pathlib import Path


class Repeat(msgspec.Struct, frozen=True, forbid_unknown_fields=True, rename={"is_loaded": "loaded"}):
    """One run of a test file.

    Attributes:
        file: the test file.
        is_loaded: whether busy processes ran beside it.
        passed: how many tests passed.
        failed: the tests that failed, each with the first line of its error.
        seconds: how long the run took.
        tree: the digest of the sources.
    """

    file: str
    is_loaded: bool
    passed: int
    failed: dict[str, str]
    seconds: float
    tree: str

    def __str__(self) -> str:
        failed = f", FAILED: {', '.join(self.failed)}" if self.failed else ""
        load = ", loaded" if self.is_loaded else ""
        return f"{self.file}: {self.passed} passed{failed} in {self.seconds:.1f} s{load}"


class Results:
    """The file of all results, which one program at a time has open.

    Raises:
        WrongInputError: the file cannot be used.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC, 0o644)
        except OSError as error:
            raise WrongInputError(f"{path} cannot be opened: {error.strerror}.") from None
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            self.repeats = self._read()
        except BlockingIOError:
            os.close(self._file)
            raise WrongInputError(f"another run of this program writes to {path}.") from None
        except BaseException:
            os.close(self._file)
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._file)

    def of(self, tree: str) -> list[Repeat]:
        """Returns the repeats of a tree."""
        return [repeat for repeat in self.repeats if repeat.tree == tree]

    def append(self, repeat: Repeat) -> None:
        """Writes a result; one that has no place is not left as half a line.

        Raises:
            WrongInputError: the disk is full, or the file cannot be written for another reason.
        """
        line = msgspec.json.encode(repeat) + b"\n"
        end = os.fstat(self._file).st_size
        try:
            # A full disk takes the first part of a line, and refuses the rest.
            while line:
                line = line[os.write(self._file, line) :]
        except OSError as error:
            os.ftruncate(self._file, end)
            raise WrongInputError(f"{self._path} cannot be written: {error.strerror}.") from None
        self.repeats.append(repeat)

    def _read(self) -> list[Repeat]:
        repeats = []
        for number, line in enumerate(self._path.read_bytes().splitlines(keepends=True), 1):
            what = "is damaged" if line.endswith(b"\n") else "ends in the middle"
            try:
                repeats.append(msgspec.json.decode(line.removesuffix(b"\n"), type=Repeat))
            except (msgspec.DecodeError, UnicodeDecodeError):
                raise WrongInputError(f"line {number} of {self._path} {what}: delete it.") from None
            if not line.endswith(b"\n"):
                raise WrongInputError(f"line {number} of {self._path} {what}: delete it.")
        return repeats


def report(repeats: Iterable[Repeat], tree: str, files: Collection[str]) -> tuple[str, bool]:
    """Returns what ever failed in the files, by tree and test, and whether some of it is of this tree."""
    runs: Counter[tuple[str, str, bool]] = Counter()
    failures: dict[tuple[str, str, str], list[tuple[bool, str]]] = defaultdict(list)
    for repeat in repeats:
        if repeat.file in files:
            runs[repeat.tree, repeat.file, repeat.is_loaded] += 1
            for test, why in repeat.failed.items():
                failures[repeat.tree, repeat.file, test].append((repeat.is_loaded, why))
    lines = []
    for (of_tree, file, test), found in sorted(failures.items(), key=lambda item: item[0][0] != tree):
        idle, loaded = (
            f"{sum(how is is_loaded for how, _ in found)} of {runs[of_tree, file, is_loaded]}"
            for is_loaded in (False, True)
        )
        where = "" if of_tree == tree else f" (another tree: {of_tree})"
        lines.append(f"FAILED {file}::{test}: {idle} idle, {loaded} loaded{where}")
        lines += [f"    {why}" for why in sorted({why for _, why in found})]
    counts = [
        sum(count for (of_tree, _, how), count in runs.items() if (of_tree, how) == (tree, is_loaded))
        for is_loaded in (False, True)
    ]
    failed = sum(of_tree == tree for of_tree, _, _ in failures)
    lines.append(
        f"{len(files)} files, {counts[0]} idle and {counts[1]} loaded repeats of this tree ({tree}):"
        f" {failed or 'no'} tests failed."
    )
    return "\n".join(lines), failed > 0
