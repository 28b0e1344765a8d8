"""The two trees: this one, and a revision in a git worktree with its own environment and page.

`var/beside/<commit>/tree` is the worktree as it was committed. `var/beside/<commit>/mixed` has the product of
that worktree and the tests of this tree, so that one benchmark measures both.
"""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Final

from tests.benchmarks.beside.reuse import VENV, reuse

KEPT: Final = Path("var", "beside")
NEEDED_GB: Final = {True: 1.0, False: 5.0}
"""Free space that is needed where an environment can be linked, and where it must be installed."""


class CannotCompareError(Exception):
    """A reason not to compare, in one sentence."""


@dataclasses.dataclass(frozen=True)
class Tree:
    """A product with its environment, and the folder from which its benchmarks are run."""

    folder: Path
    python: Path
    commit: str
    changed: bool = False


def git(root: Path, *arguments: str) -> str:
    """Returns what git prints; where it fails, its last line is the error."""
    try:
        done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=True)
    except FileNotFoundError:
        raise CannotCompareError("git is missing; install it to compare with another revision.") from None
    except subprocess.CalledProcessError as error:
        lines = error.stderr.strip().splitlines() or ["no reason"]
        raise CannotCompareError(f"`git {arguments[0]}` failed: {lines[-1]}") from None
    return done.stdout.strip()


def this_tree(root: Path) -> Tree:
    """Returns this tree; it must be a git checkout."""
    with contextlib.suppress(CannotCompareError):
        if Path(git(root, "rev-parse", "--show-toplevel")).resolve() == root:
            changed = bool(git(root, "status", "--porcelain"))
            return Tree(root, Path(sys.executable), git(root, "rev-parse", "HEAD"), changed)
    raise CannotCompareError(f"{root} is not a git checkout; clone the repository to compare revisions.")


def commit_of(root: Path, revision: str) -> str:
    """Returns the full commit id of a revision."""
    try:
        return git(root, "rev-parse", "--verify", "--quiet", "--end-of-options", f"{revision}^{{commit}}")
    except CannotCompareError:
        raise CannotCompareError(
            f"There is no revision {revision!r} here; `git fetch` may bring it."
        ) from None


def content_of(root: Path) -> str:
    """Returns a digest of all that a tree has beyond its commit."""
    text = git(root, "diff", "HEAD", "--binary") + git(root, "rev-parse", "HEAD")
    names = git(root, "ls-files", "--others", "--exclude-standard", "-z").split("\0")
    digest = hashlib.sha256(text.encode())
    for path in (root / name for name in names if name):
        digest.update(str(path).encode() + (path.read_bytes() if path.is_file() else b""))
    return digest.hexdigest()


class Beside:
    """The kept worktree of one revision."""

    def __init__(self, root: Path, revision: str) -> None:
        self._root = root
        self.commit = commit_of(root, revision)
        self.kept = root / KEPT / self.commit[:12]
        self.tree, self.mixed = self.kept / "tree", self.kept / "mixed"

    def build(self) -> None:
        """Makes the worktree, its environment and its page, or brings them up to date."""
        git(self._root, "worktree", "prune")
        check_space(self._root, is_linked=(self.tree / VENV).exists() or (self._root / VENV).exists())
        if self.tree.exists():
            self._check()
        else:
            self._add()
        linked = reuse(self._root, self.tree)
        if linked:
            print(f"beside: linked {', '.join(linked)} of this tree, which are equal", flush=True)
        set_up(self.tree)
        self._mix()

    def _add(self) -> None:
        self.kept.mkdir(parents=True, exist_ok=True)
        try:
            git(self._root, "worktree", "add", "--detach", "--force", str(self.tree), self.commit)
        except BaseException:
            self.remove()
            raise

    def _check(self) -> None:
        try:
            is_whole = Path(git(self.tree, "rev-parse", "--show-toplevel")).resolve() == self.tree.resolve()
            head, changes = git(self.tree, "rev-parse", "HEAD"), git(self.tree, "status", "--porcelain")
        except CannotCompareError:
            is_whole, head, changes = False, "", ""
        wrong = "is not a whole worktree" if not is_whole else "has uncommitted changes" if changes else ""
        if is_whole and head != self.commit:
            wrong = f"is no longer at {self.commit[:12]}"
        if wrong:
            shown = self.tree.relative_to(self._root)
            raise CannotCompareError(f"{shown} {wrong}; see what it has, or remove it by `--clean`.")

    def _mix(self) -> None:
        shutil.rmtree(self.mixed, ignore_errors=True)
        self.mixed.mkdir()
        for path in self.tree.iterdir():
            if path.name not in (".git", "tests", "var"):
                (self.mixed / path.name).symlink_to(path)
        listed = git(self._root, "ls-files", "-z", "-co", "--exclude-standard", "tests")
        for name in filter(None, listed.split("\0")):
            source, target = self._root / name, self.mixed / name
            if source.is_file():
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(source, target)

    def product(self) -> Tree:
        """Returns the revision's product with this tree's tests."""
        return Tree(self.mixed, self.tree / VENV / "bin" / "python", self.commit)

    def own(self) -> Tree:
        """Returns the revision with its own tests."""
        return Tree(self.tree, self.tree / VENV / "bin" / "python", self.commit)

    def remove(self) -> None:
        """Removes the worktree and all that belongs to it."""
        shutil.rmtree(self.kept, ignore_errors=True)
        git(self._root, "worktree", "prune")
        with contextlib.suppress(OSError):
            self.kept.parent.rmdir()


def check_space(root: Path, *, is_linked: bool) -> None:
    """Refuses to begin where the disk would become full."""
    free_gb, needed_gb = shutil.disk_usage(root).free / 1e9, NEEDED_GB[is_linked]
    if free_gb < needed_gb:
        raise CannotCompareError(
            f"{free_gb:.1f} GB are free at {root / KEPT}, and {needed_gb:.0f} GB are needed."
        )


def set_up(root: Path) -> None:
    """Runs a tree's own set-up for tests, by the Python of which environments are made."""
    name = f"python{sys.version_info.major}.{sys.version_info.minor}"
    base = Path(sys.base_prefix) / "bin" / name
    python = str(base) if base.exists() else shutil.which(name) or sys.executable
    environment = {
        key: value for key, value in os.environ.items() if key not in ("VIRTUAL_ENV", "PYTHONPATH")
    }
    done = subprocess.run([python, "backend/setup", "test"], cwd=root, env=environment, check=False)
    if done.returncode:
        raise CannotCompareError(f"The set-up of {root} failed; what it says stands above.")
