"""The files of the working tree, or of a commit, each with a digest of its content."""

from __future__ import annotations

import hashlib
import os
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.tools.selection.table import ROOT

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

# What set-up, runs and editors make is no input of a test: as in .gitignore, for trees without git.
FOLDER_NAMES: Final = {
    *(".git", ".venv", "node_modules", "__pycache__", ".mypy_cache", ".ruff_cache", ".pytest_cache"),
    *(".hypothesis", ".import_linter_cache"),
}
FOLDERS: Final = {"var", "frontend/dist", "frontend/coverage", "tests/e2e/output"}
FILES: Final = {"docker/.env", "docker/ca.crt", "frontend/tsconfig.tsbuildinfo"}
NOT_ENTERED_SUFFIX: Final = ".egg-info"
# The tables themselves change with each full run.
OWN: Final = {"tests/durations.json", "tests/loaded.json", "tests/executed.json"}


def working_tree(root: Path = ROOT) -> dict[str, str]:
    """Returns the files below a folder by their paths, with digests as git has them for blobs."""
    return {path: blob((root / path).read_bytes()) for path in _walk(root)}


def _walk(root: Path) -> Iterator[str]:
    for folder, folders, names in os.walk(root):
        above = Path(folder).relative_to(root)
        folders[:] = [
            name
            for name in folders
            if name not in FOLDER_NAMES
            and (above / name).as_posix() not in FOLDERS
            and not name.endswith(NOT_ENTERED_SUFFIX)
        ]
        for name in names:
            path = (above / name).as_posix()
            if path not in FILES | OWN and not (root / path).is_symlink():
                yield path


def commit_tree(commit: str, root: Path = ROOT) -> dict[str, str]:
    """Returns the files of a commit with their digests.

    Raises:
        subprocess.CalledProcessError: git knows no such commit.
    """
    listed = subprocess.run(
        ["git", "ls-tree", "-r", "-z", commit], cwd=root, check=True, capture_output=True, text=True
    ).stdout
    found: dict[str, str] = {}
    for line in listed.split("\0"):
        if line:
            facts, path = line.split("\t", 1)
            found[path] = facts.split()[2]
    return {path: blob for path, blob in found.items() if path not in OWN}


def blob(content: bytes) -> str:
    """Returns the digest of a file as git has it."""
    return hashlib.sha1(b"blob %d\0" % len(content) + content, usedforsecurity=False).hexdigest()


def digest(tree: Mapping[str, str]) -> str:
    """Returns a digest of a tree, or of a part of one."""
    text = "".join(f"{path}\0{tree[path]}\n" for path in sorted(tree))
    return hashlib.sha256(text.encode()).hexdigest()[:16]
