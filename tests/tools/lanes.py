"""`make test-python`: the browser's tests and all others beside each other, since each mostly waits.

Every line is shown as it comes, with the name of its lane; failures are listed again at the end.
Arguments go to each run of pytest.
"""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
# Tests of the browser that the other lane runs at its end, so that both end at about the same time.
LATE: Final = [f"tests/e2e/test_{name}.py" for name in ("screens", "follow_person", "run_panels")]
# The arguments of each lane for pytest, one run after the other.
LANES: Final = {
    "browser": [["tests/e2e", *(f"--ignore={path}" for path in LATE)]],
    "others": [["tests", "--ignore=tests/e2e"], LATE],
}
# The beginnings of lines in pytest's summary that report a failure.
FAILURES: Final = ("FAILED tests/", "ERROR tests/")


def main(arguments: list[str]) -> int:
    """Runs the lanes to their ends; returns 0 if all passed."""
    began_s = time.monotonic()
    lanes = [Lane(name, runs, arguments) for name, runs in LANES.items()]
    try:
        for lane in lanes:
            lane.start()
        for lane in lanes:
            lane.join()
    except KeyboardInterrupt:  # the lanes' runs were interrupted too, and print their summaries
        for lane in lanes:
            lane.is_ended = True
            lane.join()
        return 130
    for lane in lanes:
        print("".join(f"{lane.name:7} | {line}" for line in lane.failures), end="")
    print(", ".join(map(str, lanes)), f"in {(time.monotonic() - began_s) / 60:.1f} min")
    return max(lane.result for lane in lanes)


class Lane(threading.Thread):
    """Runs of pytest, one after the other; the rest runs also after a failure."""

    def __init__(self, name: str, runs: list[list[str]], arguments: list[str]) -> None:
        super().__init__(name=name)
        self.result = 0
        self.is_ended = False
        self.failures: list[str] = []
        self._commands = [[sys.executable, "-m", "pytest", *run, *arguments] for run in runs]

    def run(self) -> None:
        for command in self._commands:
            if not self.is_ended:
                self.result = max(self.result, self._show(command))

    def _show(self, command: list[str]) -> int:
        with subprocess.Popen(
            command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ) as process:
            for line in process.stdout or ():
                print(f"{self.name:7} | {line}", end="", flush=True)
                if line.startswith(FAILURES):
                    self.failures.append(line)
        return abs(int(process.returncode))

    def __str__(self) -> str:
        return f"{self.name} {'passed' if self.result == 0 else f'FAILED ({self.result})'}"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
