"""Builds the wheel of the engine, and makes environments that have it and what it requires alone."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).resolve().parents[2]
VERSIONS: Final = ("3.10", "3.11", "3.12", "3.13")
# py_trees imports pydot, which imports pyparsing. All three are pure Python.
PURE: Final = ("py_trees", "pydot", "pyparsing")
CORPUS: Final = sorted(
    path
    for pattern in ("*.jsonl", "*.jsonl.gz", "script_table.json")
    for path in (ROOT / "tests" / "conformance").glob(pattern)
)


def interpreter(version: str) -> str | None:
    """The path of a Python of this machine, or None."""
    found = shutil.which(f"python{version}")
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    return next((str(path) for path in sorted(pyenv.glob(f"{version}.*/bin/python"))), found)


def interpreters() -> dict[str, str]:
    """Returns the Pythons of this machine for the engine, by version; the one that runs is among them."""
    running = ".".join(map(str, sys.version_info[:2]))
    found = {version: interpreter(version) for version in VERSIONS}
    return {version: path for version, path in (found | {running: sys.executable}).items() if path}


def build_wheel(folder: Path) -> Path:
    """Builds the wheel of a copy of the sources, and returns it."""
    copied = folder / "sources" / "tree_gardener"
    shutil.copytree(ROOT / "tree_gardener", copied, ignore=shutil.ignore_patterns("__pycache__", ".*"))
    build = [_uv(), "build", "--wheel", "--offline", "--quiet", "--no-build-isolation"]
    _run([*build, "--python", sys.executable, "--out-dir", folder / "out", copied], folder)
    [wheel] = (folder / "out").glob("*.whl")
    return wheel


def make_environment(python: str, folder: Path, wheel: Path) -> Path:
    """Makes an environment without the network; returns its Python.

    py_trees comes from the environment that runs. So does lxml, where it fits; the corpus does not load it.
    """
    _run([python, "-m", "venv", "--without-pip", folder], folder.parent)
    own = folder / "bin" / "python"
    options = ("--offline", "--quiet", "--no-deps", "--python")
    _run([_uv(), "pip", "install", *options, own, wheel], folder)
    [site] = folder.glob("lib/python3*/site-packages")
    for name in (*PURE, *(("lxml",) if python == sys.executable else ())):
        _copy(name, site)
    return own


def run_corpus(own: Path, folder: Path, *, most: int) -> dict[str, Any]:
    """Runs so many cases of each file with the Python of an environment; returns what `corpus.py` prints."""
    script = Path(__file__).with_name("corpus.py")
    done = subprocess.run(
        [own, "-I", script, str(most), *CORPUS], cwd=folder, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise AssertionError(done.stderr)
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def _run(command: list[str | Path], folder: Path) -> None:
    """Runs a command that keeps its temporary files in a folder."""
    subprocess.run(command, env={**os.environ, "TMPDIR": str(folder)}, check=True)


def _copy(name: str, site: Path) -> None:
    for file in metadata.distribution(name).files or ():
        if ".." not in file.parts and file.suffix != ".pyc":
            target = site / file
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(str(file.locate()), target)


def _uv() -> str:
    return str(Path(sys.executable).with_name("uv"))
