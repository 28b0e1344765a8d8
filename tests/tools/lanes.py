"""`make test-python`: two runs of pytest beside each other, since tests of browsers and robots mostly wait.

Every line is shown as it comes, with the name of its lane; failures and their errors are listed again at the
end. The two lanes share the machine, so a test that waits for other processes can run out of time that it has
alone: a few tests that failed are run again after the lanes. One that fails again has failed; one that passes
stays listed as unsteady. Arguments go to each run of pytest.
"""

from __future__ import annotations

import re
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
# The browser's tests take less time than the others: these folders run before them.
WITH_THE_BROWSER: Final = [
    "tests/translator",
    "tests/tree_gardener",
    "tests/contracts",
    "tests/tools",
    "tests/executor/exact",
    "tests/executor/recorder",
    "tests/executor/ros",
    "tests/executor/session",
    "tests/executor/world",
]
# The arguments of each lane for pytest.
LANES: Final = {
    "browser": ["tests/e2e", *WITH_THE_BROWSER],
    "others": ["tests", *(f"--ignore={folder}" for folder in ("tests/e2e", *WITH_THE_BROWSER))],
}
# Results of pytest; all others mean that its run did not come to its end.
PASSED: Final = 0
TESTS_FAILED: Final = 1
NOT_COMPLETE: Final = 2
# More failed tests than these have another cause than a busy machine.
AGAIN_AT_MOST: Final = 3
# The lines of an error that are shown again at the end.
ERROR_LINES: Final = 6
_FAILURE: Final = re.compile(r"(?P<how>FAILED|ERROR) (?P<test>tests/[^\s\[]+(?:\[.*?\](?= - |\s*$))?)")
_TITLE: Final = re.compile(r"_{3,} .+ _{3,}$")


def main(arguments: list[str]) -> int:
    """Runs the lanes to their ends, then a few failed tests alone; returns 0 if all passed."""
    began_s = time.monotonic()
    lanes = [Lane(name, pytest(*run, *arguments)) for name, run in LANES.items()]
    try:
        for lane in lanes:
            lane.start()
        for lane in lanes:
            lane.join()
    except KeyboardInterrupt:  # the lanes' runs were interrupted too, and print their summaries
        for lane in lanes:
            lane.join()
        return 130
    is_complete = all(lane.result in (PASSED, TESTS_FAILED) for lane in lanes)
    tests = to_repeat([line for lane in lanes for line in lane.failures]) if is_complete else []
    again = [Lane("again", pytest(*tests, *arguments))] if tests else []
    for lane in again:
        lane.run()
    report = [*lanes, *again]
    for lane in report:
        print("".join(f"{lane.name:7} | {line}" for line in lane.summary), end="")
    if again and again[0].result == PASSED:
        print(f"UNSTEADY, passed when run alone: {' '.join(tests)}")
    print(", ".join(map(str, report)), f"in {(time.monotonic() - began_s) / 60:.1f} min")
    return max(lane.result for lane in again or lanes)


def pytest(*arguments: str) -> list[str]:
    """Returns the command of a run of pytest."""
    return [sys.executable, "-m", "pytest", *arguments]


def to_repeat(failures: list[str]) -> list[str]:
    """Returns the tests that are run again: all that failed, if they are few and each ran."""
    found = [match for line in failures if (match := _FAILURE.match(line))]
    ran = [match["test"] for match in found if match["how"] == "FAILED"]
    return ran if len(ran) == len(found) <= AGAIN_AT_MOST else []


class Lane(threading.Thread):
    """A run of pytest, whose lines are shown with the name of the lane."""

    def __init__(self, name: str, command: list[str]) -> None:
        super().__init__(name=name)
        self.result = PASSED
        self.failures: list[str] = []
        self._errors: list[list[str]] = []
        self._command = command

    @property
    def summary(self) -> list[str]:
        """The failures, and under them the beginnings of their errors."""
        return [*self.failures, *(line for error in self._errors for line in error[:ERROR_LINES])]

    def run(self) -> None:
        with subprocess.Popen(
            self._command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ) as process:
            for line in process.stdout or ():
                print(f"{self.name:7} | {line}", end="", flush=True)
                self.read(line)
        self.result = abs(process.returncode)
        if self.result == TESTS_FAILED and not self.failures:  # it ended before its summary
            self.result = NOT_COMPLETE

    def read(self, line: str) -> None:
        """Keeps a line of pytest's output if it names a failure or says what failed."""
        if _FAILURE.match(line):
            self.failures.append(line)
        elif _TITLE.match(line.rstrip()):
            self._errors.append([])
        elif line.startswith("E  ") and self._errors:
            self._errors[-1].append(line)

    def __str__(self) -> str:
        return f"{self.name} {'passed' if self.result == PASSED else f'FAILED ({self.result})'}"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
