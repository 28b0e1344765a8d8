"""`make test-python`: the browser's tests and all others beside each other, since each mostly waits.

Every line of the two runs is shown as it comes, with its lane before it. Arguments go to both.
"""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import IO, Final

ROOT: Final = Path(__file__).resolve().parents[2]
LANES: Final = {
    "browser": ["tests/e2e"],
    "others": ["tests", "--ignore", "tests/e2e"],
}


def main(arguments: list[str]) -> int:
    """Runs both lanes to their ends; returns 0 if both passed."""
    began_s = time.monotonic()
    lanes = {name: _start(paths, arguments) for name, paths in LANES.items()}
    readers = [threading.Thread(target=_show, args=(name, lane.stdout)) for name, lane in lanes.items()]
    for reader in readers:
        reader.start()
    try:
        results = {name: lane.wait() for name, lane in lanes.items()}
        for reader in readers:
            reader.join()
    except KeyboardInterrupt:  # both lanes were interrupted too, and say what they did
        for lane in lanes.values():
            lane.wait()
        return 130
    told = [f"{name} {'passed' if code == 0 else f'FAILED ({code})'}" for name, code in results.items()]
    print(", ".join(told), f"in {(time.monotonic() - began_s) / 60:.1f} min")
    return max(results.values())


def _start(paths: list[str], arguments: list[str]) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "pytest", *paths, *arguments]
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def _show(name: str, output: IO[str] | None) -> None:
    for line in output or ():
        print(f"{name:7} | {line}", end="", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
