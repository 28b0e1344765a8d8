"""No folder of Python has over twenty modules without a reason; `frontend/tools/rooms.js` tests the page."""

from __future__ import annotations

import subprocess
from collections import Counter
from pathlib import Path, PurePosixPath
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
MOST: Final = 20
ROOTS: Final = ("backend", "docker", "executor", "translator", "tree_gardener", "tests")
LARGE: Final = {
    "tree_gardener": "import paths of the engine are public: exported packages and users' actions use them",
    "tree_gardener/nav2": "one module a node of Nav2; a project takes the source of one",
    "translator/check": "one module a rule, and what several rules read",
    "translator": "import paths are public; each module is one form of a project or one step of translation",
    "tests/benchmarks": "one module a benchmark",
    "executor/headless": "one module a part of a run in the terminal, and its tools",
    "executor/supervision": "one module a rule for processes, which every room of the executor uses",
    "tests/fakes": "one module a fake",
    "tests/tools": "one module a tool of developers",
}
"""The folders that may have more, each with its reason."""


def sizes() -> Counter[str]:
    """Returns the number of modules by folder; tests do not count, since each mirrors its module."""
    listed = subprocess.run(["git", "ls-files", *ROOTS], cwd=ROOT, capture_output=True, text=True, check=True)
    paths = [PurePosixPath(name) for name in listed.stdout.splitlines()]
    modules = (path for path in paths if path.suffix == ".py" and not path.name.startswith(("__", "test_")))
    return Counter(str(path.parent) for path in modules)


def test_a_folder_is_small_or_has_a_reason():
    assert {folder for folder, size in sizes().items() if size > MOST} == set(LARGE)
