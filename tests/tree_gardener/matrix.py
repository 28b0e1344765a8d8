"""Runs the engine's tests on other Pythons and with the oldest py_trees that we support.

    python -m tests.tree_gardener.matrix

Uses the interpreters 3.10 to 3.13 that pyenv or the PATH offer, each in a fresh environment outside of the
clone. In another one pip installs the engine's wheel with what it requires, and the corpus runs on it.
Left out are the tests that need what those environments lack: the command line, ROS, behaviortreepy.
"""

# ruff: noqa: T201 - it is a program

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from tests.tree_gardener.distribution import ROOT, VERSIONS, build_wheel, interpreter, run_corpus

EVERY = 1_000_000
PY_TREES = ("py_trees==2.3.*", "py_trees")
TESTS = (
    *("test_actions", "test_blackboard", "test_document", "test_forest", "test_hooks", "test_loading"),
    *("test_observe", "test_ports", "test_registry", "test_runner", "test_tree", "test_values", "test_views"),
    *("conformance", "controls", "decorators", "generated", "leaves", "script"),
)


def run(python: str, py_trees: str, folder: Path) -> bool:
    """Runs the tests in a new environment."""
    subprocess.run([python, "-m", "venv", folder], check=True)
    own = folder / "bin" / "python"
    packages = [py_trees, "lxml", "pytest", "pytest-timeout", "hypothesis"]
    subprocess.run([own, "-m", "pip", "install", "-q", "--disable-pip-version-check", *packages], check=True)
    settings = folder / "pytest.ini"
    settings.write_text("[pytest]\nfilterwarnings = error\n")
    tests = TESTS if "2.3" in py_trees else (*TESTS, "test_rebind")
    place = ROOT / "tests" / "tree_gardener"
    files = [str(place / name if (place / name).is_dir() else place / f"{name}.py") for name in tests]
    options = [
        "-q",
        "-c",
        str(settings),
        f"--rootdir={ROOT}",
        "--import-mode=importlib",
        "-p",
        "no:cacheprovider",
    ]
    done = subprocess.run([own, "-m", "pytest", *options, *files], cwd=ROOT, check=False)
    return done.returncode == 0


def run_wheel(python: str, py_trees: str, folder: Path, wheel: Path) -> bool:
    """Runs the corpus on the installed wheel."""
    subprocess.run([python, "-m", "venv", folder], check=True)
    own = folder / "bin" / "python"
    options = ("-q", "--disable-pip-version-check")
    subprocess.run([own, "-m", "pip", "install", *options, wheel, py_trees], check=True)
    subprocess.run([own, "-m", "pip", "check"], check=True)
    found = run_corpus(own, folder, most=EVERY)
    print(f"{sum(found['counts'].values())} cases on the wheel, {len(found['failed'])} failed", flush=True)
    return not found["failed"]


def main() -> int:
    """Runs all combinations; returns the exit status."""
    with tempfile.TemporaryDirectory() as folder:
        return run_all(build_wheel(Path(folder)))


def run_all(wheel: Path) -> int:
    """Runs all combinations with a wheel; returns the exit status."""
    failed = []
    for version in VERSIONS:
        python = interpreter(version)
        if python is None:
            print(f"Python {version} is not here")
            continue
        for py_trees in PY_TREES:
            print(f"== Python {version}, {py_trees}", flush=True)
            with tempfile.TemporaryDirectory() as folder:
                passed = run(python, py_trees, Path(folder) / "venv")
                passed = run_wheel(python, py_trees, Path(folder) / "alone", wheel) and passed
                if not passed:
                    failed.append(f"Python {version}, {py_trees}")
    print("failed: " + "; ".join(failed) if failed else "all passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
