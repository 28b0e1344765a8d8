"""The engine by itself: the size of its wheel, and what its import costs beside that of py_trees.

`python -m tests.benchmarks distribution`. Each import is the first one of a new process, in an environment
with the wheel and what it requires; times are of the processor, and the processes take turns.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.benchmarks.figures import Figure, show
from tests.tree_gardener.distribution import build_wheel, make_environment

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

ROUNDS: Final = 15
IMPORTS: Final = {
    "import tree_gardener": "import tree_gardener",
    "from tree_gardener import Tree, without py_trees' own part": (
        "import py_trees; START = time.process_time(); from tree_gardener import Tree"
    ),
    "from tree_gardener import Tree, with it": "from tree_gardener import Tree",
    "import py_trees": "import py_trees",
}


def measure(_: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the figures."""
    with tempfile.TemporaryDirectory() as folder:
        wheel = build_wheel(Path(folder))
        yield Figure("the wheel", wheel.stat().st_size / 1000, "KB")
        python = make_environment(sys.executable, Path(folder) / "env", wheel)
        times: dict[str, list[float]] = {name: [] for name in IMPORTS}
        for number in range(ROUNDS + 1):
            for name, code in IMPORTS.items():
                taken_ms = _taken_ms(python, code)
                if number:  # the first one writes bytecode
                    times[name].append(taken_ms)
    for name, taken in times.items():
        yield Figure(f"{name}, median of {ROUNDS} processes", statistics.median(taken), "ms")


def _taken_ms(python: Path, code: str) -> float:
    """Returns the processor time of an import in a new process."""
    program = f"import time; START = time.process_time(); {code}; print(time.process_time() - START)"
    done = subprocess.run([python, "-I", "-c", program], capture_output=True, text=True, check=True)
    return float(done.stdout) * 1000


def main() -> None:
    """Prints the figures."""
    show(measure())


if __name__ == "__main__":
    main()
