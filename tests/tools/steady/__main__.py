"""Repeats each test file and lists what ever failed: `python -m tests.tools.steady [FILES…]`.

    python -m tests.tools.steady [--repeats 20] [--loaded 10] [--slice 600] [--report] [FILES…]

Each repeat of a file is a run of pytest, or of vitest for the page, in its own process; `--loaded` of
the `--repeats` have eight busy processes beside. Each is a line of `var/steady.jsonl`, with the digest of the
tree that ran. All files have their first repeat before one has its second. No repeat begins after `--slice`
seconds; the same command continues where this one ended, as long as the tree is the same. FILES are files or
folders; without them all tests run. `--report` runs nothing.

Exit status 0: nothing failed on this tree; 1: something did; 2: bad input; 130: it was interrupted.
"""

from __future__ import annotations

import argparse
import signal
import sys
import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Final, NoReturn

from tests.tools.steady import files as steady_files
from tests.tools.steady import runs as steady_runs
from tests.tools.steady.files import WrongInputError
from tests.tools.steady.results import Repeat, Results, report

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

ROOT: Final = Path(__file__).resolve().parents[3]
FAILED: Final = 1
WRONG: Final = 2
INTERRUPTED: Final = 130


def main(arguments: Sequence[str], root: Path = ROOT) -> int:
    """Repeats the files of a tree, and reports."""
    wanted = _parsed(arguments)
    try:
        with Results(root / "var" / "steady.jsonl") as results:
            files = steady_files.find(root, wanted.files)
            tree = steady_files.digest(root)
            is_interrupted = not wanted.report and _repeat(root, files, tree, results, wanted)
            text, has_failures = report(results.repeats, tree, files)
    except WrongInputError as error:
        print(f"steady: {error}", file=sys.stderr)
        return WRONG
    print(text)
    if is_interrupted:
        print("steady: it was interrupted; the same command continues.", file=sys.stderr)
        return INTERRUPTED
    return FAILED if has_failures else 0


def _repeat(root: Path, files: list[str], tree: str, results: Results, wanted: argparse.Namespace) -> bool:
    """Runs what is left until the slice is over; returns whether it was interrupted."""
    end_s = time.monotonic() + wanted.slice
    left = list(to_do(files, results.of(tree), wanted.repeats, wanted.loaded))
    try:
        for number, (file, is_loaded) in enumerate(left, 1):
            if time.monotonic() > end_s:
                break
            repeat = steady_runs.run(root, file, tree, is_loaded=is_loaded)
            results.append(repeat)
            print(f"{number}/{len(left)} {repeat}", flush=True)
    except KeyboardInterrupt:
        return True
    return False


def to_do(files: list[str], done: list[Repeat], repeats: int, loaded: int) -> Iterator[tuple[str, bool]]:
    """Yields files, and whether the machine is busy: round by round, the busy rounds between the others."""
    left = Counter((repeat.file, repeat.is_loaded) for repeat in done)
    for number in range(repeats):
        is_loaded = (number + 1) * loaded // repeats > number * loaded // repeats
        for file in files:
            if left[file, is_loaded] > 0:
                left[file, is_loaded] -= 1
            else:
                yield file, is_loaded


def _parsed(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="steady", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("files", nargs="*", metavar="FILES")
    parser.add_argument("--repeats", type=int, default=20)
    parser.add_argument("--loaded", type=int, help="half of the repeats, if it is left out")
    parser.add_argument("--slice", type=float, default=600, help="seconds")
    parser.add_argument("--report", action="store_true")
    wanted = parser.parse_args(arguments)
    if wanted.loaded is None:
        wanted.loaded = wanted.repeats // 2
    if wanted.repeats < 1:
        parser.error("--repeats is 1 at least")
    if not 0 <= wanted.loaded <= wanted.repeats:
        parser.error(f"--loaded is from 0 to the {wanted.repeats} repeats")
    if not wanted.slice > 0:
        parser.error("--slice is more than 0 seconds")
    return wanted


def _interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, _interrupt)
    sys.exit(main(sys.argv[1:]))
