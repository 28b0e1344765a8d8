"""`python -m tests.benchmarks NAME… [options] --beside REVISION`: this tree and another revision in turn."""

from __future__ import annotations

import argparse
import dataclasses
import fcntl
import json
import os
import platform
import signal
import statistics
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TextIO

from tests.benchmarks.beside.pairs import HEAD, compared
from tests.benchmarks.beside.runs import PROCESSOR, WHOLE, FailedError, Task, run
from tests.benchmarks.beside.trees import (
    KEPT,
    Beside,
    CannotCompareError,
    Tree,
    content_of,
    set_up,
    this_tree,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tests.benchmarks.figures import Figure

Pair = tuple["list[Figure]", "list[Figure]"]
ROOT: Final = Path(__file__).resolve().parents[3]
PAIRS: Final = 7


def parser() -> argparse.ArgumentParser:
    """The options of a comparison; all others are the benchmark's own."""
    options = argparse.ArgumentParser(
        prog="python -m tests.benchmarks NAME… [options of the benchmark]",
        description="Compares this tree with another revision; every other option goes to the benchmark.",
        allow_abbrev=False,
    )
    options.add_argument("--beside", metavar="REVISION", help="the other revision, by any name git knows")
    options.add_argument("--pairs", type=int, default=PAIRS, help=f"runs of each tree (default {PAIRS})")
    options.add_argument("--json", type=Path, metavar="FILE", help="appends a line for each pair")
    options.add_argument("--clean", action="store_true", help="removes the kept worktree at the end")
    return options


def main(names: Sequence[str], options: argparse.Namespace, own: Sequence[str]) -> int:
    """Compares, and returns the exit code; each reason not to is one sentence."""
    try:
        _compare(names, options, own)
    except CannotCompareError as error:
        print(f"beside: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"beside: {error.strerror or error} ({error.filename or KEPT}).", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"\nbeside: Interrupted; nothing runs, the worktree in {KEPT} is kept.", file=sys.stderr)
        return 130
    return 0


def _compare(names: Sequence[str], options: argparse.Namespace, own: Sequence[str]) -> None:
    if options.pairs < 1:
        raise CannotCompareError("--pairs is at least 1.")
    for number in (signal.SIGINT, signal.SIGTERM):  # a shell in the background ignores the first
        signal.signal(number, signal.default_int_handler)
    ours = this_tree(ROOT)
    beside = Beside(ROOT, options.beside)
    with locked(ROOT), _lines(options.json) as lines:
        if names:
            set_up(ROOT)
            beside.build()
            before = content_of(ROOT)
            facts = introduce(ours, beside)
            for name in names:
                Session(ours, beside, options.pairs, lines, facts).compare(Task(name, own))
            print(f"load at the end {os.getloadavg()[0]:.1f}")
            if content_of(ROOT) != before:
                print("This tree was changed meanwhile: its figures are of a mixture.")
        if options.clean:
            beside.remove()
            print(f"beside: removed {beside.kept.relative_to(ROOT)}")


@contextmanager
def locked(root: Path) -> Iterator[None]:
    """Holds a lock of this tree, so that one comparison runs in it at a time."""
    path = root / KEPT / "lock"
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise CannotCompareError("Another comparison runs in this tree; wait for its end.") from None
        yield


@contextmanager
def _lines(path: Path | None) -> Iterator[TextIO | None]:
    if path is None:
        yield None
        return
    with path.open("a", encoding="utf-8") as lines:
        yield lines


def introduce(ours: Tree, beside: Beside) -> dict[str, Any]:
    """Prints what is compared, and where; returns the same for the lines of JSON."""
    changes = " with uncommitted changes" if ours.changed else ""
    load = os.getloadavg()[0]
    print(f"this tree {ours.commit[:12]}{changes}, beside {beside.commit[:12]}")
    print(f"{machine()}; load at the start {load:.1f}")
    return {
        "commit": ours.commit,
        "changed": ours.changed,
        "beside": beside.commit,
        "machine": machine(),
        "load_at_start": load,
    }


def machine() -> str:
    """Returns the kind of the machine."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), "")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9
    cores = len(os.sched_getaffinity(0))
    return (
        f"{cores} cores, {model or platform.machine()}, {memory:.0f} GB, CPython {platform.python_version()}"
    )


class Session:
    """The runs of one benchmark, first one of each tree that does not count, then the pairs."""

    def __init__(
        self, ours: Tree, beside: Beside, pairs: int, lines: TextIO | None, facts: dict[str, Any]
    ) -> None:
        self._ours, self._beside = ours, beside
        self._other = beside.product()
        self._pairs, self._lines, self._facts = pairs, lines, facts

    def compare(self, task: Task) -> None:
        """Runs all pairs and prints the comparison."""
        print(f"\n== {task.name} {' '.join(task.options)}".rstrip(), flush=True)
        task = self._warm_up(task)
        pairs: list[Pair] = []
        try:
            for number in range(1, self._pairs + 1):
                pair = (self._run(self._ours, task), self._run(self._other, task))
                pairs.append(pair)
                self._write(task, number, pair)
                print(f"pair {number} of {self._pairs}: {_progress(pair)}", flush=True)
        finally:  # also what was measured before Ctrl+C
            _report(pairs)

    def _warm_up(self, task: Task) -> Task:
        """Runs both once; a benchmark that the other product does not fit is compared as a whole."""
        self._run(self._ours, task)
        try:
            self._run(self._other, task)
        except FailedError as error:
            print(
                f"Today's benchmark fails with that revision, so each tree runs its own, as a whole: {error}"
            )
            task = dataclasses.replace(task, kind=WHOLE)
            self._other = self._beside.own()
            self._run(self._ours, task)
            self._run(self._other, task)
        print("a run of each as warm-up, which does not count", flush=True)
        return task

    def _run(self, tree: Tree, task: Task) -> list[Figure]:
        side = "ours" if tree is self._ours else "other"
        return run(ROOT, tree, task, self._beside.kept / f"{side}.log")

    def _write(self, task: Task, number: int, pair: Pair) -> None:
        if self._lines is None:
            return
        comparisons, _ = compared([pair])
        figures = {
            each.figure.name: {
                "unit": each.figure.unit,
                "better": each.figure.better,
                "this_tree": each.ours[0],
                "beside": each.others[0],
                "ratio": each.ratios[0],
            }
            for each in comparisons
        }
        line = {"benchmark": task.name, "options": [*task.options], "kind": task.kind, "pair": number}
        load = {"load": os.getloadavg()[0]}
        self._lines.write(json.dumps(line | load | self._facts | {"figures": figures}) + "\n")
        self._lines.flush()


def _report(pairs: list[Pair]) -> None:
    if not pairs:
        return
    comparisons, missing = compared(pairs)
    print(HEAD)
    for comparison in comparisons:
        print(comparison)
    if missing:
        print(f"measured in one tree only: {', '.join(missing)}")


def _progress(pair: Pair) -> str:
    """Returns the processor time and the middle ratio of all figures of a pair."""
    comparisons, _ = compared([pair])
    used = next(each for each in comparisons if each.figure.name == PROCESSOR)
    middle = statistics.median(each.ratios[0] for each in comparisons)
    return (
        f"{used.ours[0]:.2f} and {used.others[0]:.2f} s of a processor, "
        f"median ratio of its figures {middle:.3f}, load {os.getloadavg()[0]:.1f}"
    )
