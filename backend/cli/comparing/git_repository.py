"""The git repository around a folder: its own config, its `.gitattributes`, and merges of lines."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Final

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

BEGIN: Final = "# begin bt-studio: trees are compared and merged by nodes (bt-studio git uninstall)"
END: Final = "# end bt-studio"
DRIVER: Final = "bt-studio"
_BLOCK: Final = re.compile(rf"(?ms)^{re.escape(BEGIN)}$.*?^{re.escape(END)}$\n?")
_PLAIN: Final = re.compile(r"[^A-Za-z0-9_./-]")


class Repository:
    """A repository; all paths are relative to its top."""

    def __init__(self, folder: Path) -> None:
        try:
            done = _git(folder, "rev-parse", "--show-toplevel")
        except FileNotFoundError:
            raise CliError("git is not installed", status=BAD_ARGUMENTS) from None
        if done.returncode != 0:
            raise CliError(f"{folder}:1:1: it is in no git repository (git init)", status=BAD_ARGUMENTS)
        self.top = Path(done.stdout.decode().rstrip("\n"))
        self.attributes = self.top / ".gitattributes"

    def tree_patterns(self) -> list[str]:
        """Returns the patterns of files with trees: diagrams, and the folders of tracked BT.CPP XML."""
        found = ["**/trees/*.json"]
        tracked = _git(self.top, "ls-files", "-z", "--", "*.xml").stdout.decode("utf-8", "replace")
        for name in filter(None, tracked.split("\0")):
            path = self.top / name
            if path.is_file() and not path.is_symlink() and b"<BehaviorTree" in path.read_bytes():
                # In a pattern, `?` stands for each character that has a meaning there.
                folder = _PLAIN.sub("?", path.parent.relative_to(self.top).as_posix())
                found.append("/*.xml" if folder == "." else f"/{folder}/*.xml")
        return list(dict.fromkeys(found))

    def block(self) -> str:
        """Returns the lines for `.gitattributes`."""
        lines = [f"{pattern} diff={DRIVER} merge={DRIVER}" for pattern in self.tree_patterns()]
        return "\n".join([BEGIN, *lines, END]) + "\n"

    def install(self) -> None:
        """Writes config and attributes; older entries of ours are replaced."""
        for key, value in settings().items():
            done = _git(self.top, "config", "--local", key, value)
            if done.returncode != 0:
                raise CliError(f"{self.top}:1:1: git config: {done.stderr.decode().strip()}")
        text = self._others()
        self.attributes.write_text(text + ("\n" if text and not text.endswith("\n") else "") + self.block())

    def uninstall(self) -> None:
        """Removes the settings that `install` wrote, and nothing else."""
        for section in (f"diff.{DRIVER}", f"merge.{DRIVER}"):
            _git(self.top, "config", "--local", "--remove-section", section)
        if not self.attributes.is_file():
            return
        if text := self._others():
            self.attributes.write_text(text)
        else:
            self.attributes.unlink()

    def _others(self) -> str:
        return _BLOCK.sub("", self.attributes.read_text()) if self.attributes.is_file() else ""


def settings() -> dict[str, str]:
    """Returns the entries of the config, with the program that runs now."""
    script = Path(sys.executable).with_name("bt-studio")
    words = [str(script)] if script.is_file() else [sys.executable, "-m", "backend.cli.main"]
    program = shlex.join(words)
    return {
        f"diff.{DRIVER}.command": f"{program} git changes",
        f"merge.{DRIVER}.name": "BT Studio: trees by their nodes",
        f"merge.{DRIVER}.driver": f"{program} merge %O %A %B -o %A --git --name %P",
        # Where git merges several common versions first, it takes none of their conflicts along.
        f"merge.{DRIVER}.recursive": "binary",
    }


def merge_lines(base: Path, ours: Path, theirs: Path, *, name: str) -> int:
    """Merges by lines into our file, with git's marks at conflicts; returns the exit status for git."""
    labels = [argument for side in ("ours", "base", "theirs") for argument in ("-L", f"{name} ({side})")]
    done = subprocess.run(
        ["git", "merge-file", *labels, "--", str(ours), str(base), str(theirs)],
        check=False,
    )
    return min(done.returncode, 1)


def show_lines(older: Path, newer: Path) -> None:
    """Prints the difference of two files by lines."""
    subprocess.run(
        ["git", "diff", "--no-index", "--no-ext-diff", "--", str(older), str(newer)],
        check=False,
    )


def _git(folder: Path, *arguments: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        ["git", "-C", str(folder), *arguments],
        capture_output=True,
        check=False,
    )
