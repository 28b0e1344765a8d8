"""The program of a run: the project in its folder, its tree, and the exchange for a changed project."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from executor.application.host import enter
from tree_gardener import Tree
from tree_gardener.action_changes import remember_actions, unchanged
from tree_gardener.actions import PACKAGE, load_actions
from tree_gardener.document import embedded_sources, parse_document
from tree_gardener.swap import Swap

if TYPE_CHECKING:
    from collections.abc import Callable

    from tree_gardener.clock import Clock

__all__ = ["Change", "NoTreeError", "Program"]

DOCUMENT = "self_contained_tree.xml"


class NoTreeError(Exception):
    """A folder holds no project."""

    def __init__(self) -> None:
        super().__init__(f"the project has no {DOCUMENT}")


class Program:
    """The project whose tree runs.

    Args:
        folder: the folder of the project, which becomes the current folder.
        clock: the clock of its trees.
    """

    def __init__(self, folder: Path, clock: Clock) -> None:
        self._clock = clock
        self._folder = folder
        self._folders = [folder]
        self._sources: dict[str, str] = {}
        self._leave: Callable[[], None] = enter(folder)

    def file_of(self, path: str) -> str:
        """Returns the name in the project of a file that the program runs; "" for one outside of it.

        A module that has not changed since an earlier program is still the one of its folder.
        """
        if path.startswith(f"{PACKAGE}/"):
            return path
        found = (path.removeprefix(f"{folder}/") for folder in self._folders if path.startswith(f"{folder}/"))
        return next(found, "")

    def text_of(self, path: str, most_bytes: int) -> str | None:
        """Returns the text of such a file; None if it is longer, or is not there any more.

        What counts is the size of the text: a byte that is not UTF-8 becomes a sign of three bytes.
        """
        name = self.file_of(path).removeprefix(f"{PACKAGE}/").removesuffix(".py")
        if path.startswith(f"{PACKAGE}/") and name in self._sources:
            data = self._sources[name].encode(errors="replace")
        else:
            data = _head(path, most_bytes + 1)
        text = data.decode(errors="replace")
        return text if 0 < len(text.encode()) <= most_bytes else None

    def load(self) -> Tree:
        """Builds the tree.

        Raises:
            LoadError: the document or an action is refused.
        """
        text = (self._folder / DOCUMENT).read_bytes()
        self._sources = embedded_sources(parse_document(text, DOCUMENT))
        return Tree.from_xml(text, load_actions(self._sources), self._clock, name=DOCUMENT)

    def change(self, folder: Path, tree: Tree) -> Change:
        """Loads a changed project beside the running one, whose tree is `tree`.

        Actions whose code is the same keep their classes, and so their objects.

        Raises:
            LoadError, NoTreeError: the project is refused; nothing has changed.
        """
        if not (folder / DOCUMENT).is_file():
            raise NoTreeError
        before = (self._folder, self._sources, self._leave)
        folders = self._folders
        forget_actions = remember_actions()
        removed: dict[str, Any] = {}
        self._leave()

        def undo() -> None:
            self._leave()
            forget_actions()
            sys.modules.update(removed)
            self._folder, self._sources, _ = before
            self._folders = folders
            self._leave = enter(self._folder)

        self._leave = enter(folder)
        try:
            text = (folder / DOCUMENT).read_bytes()
            sources = embedded_sources(parse_document(text, DOCUMENT))
            same = unchanged(self._sources | _others(self._folder), others := sources | _others(folder))
            removed |= _remove_modules(self._folder, {name for name in others if name not in same})
            classes = load_actions(sources, keep=same & sources.keys())
            swap = Swap(tree, Tree.from_xml(text, classes, self._clock, name=DOCUMENT))
        except BaseException:
            undo()
            raise
        self._folder, self._sources = folder, sources
        self._folders = [folder, *folders]
        return Change(swap, undo)


class Change:
    """A changed project that is loaded, and can replace the running one.

    Attributes:
        swap: the exchange of the trees, and its plan.
        undo: leaves everything as it was before; not after the exchange.
    """

    def __init__(self, swap: Swap, undo: Callable[[], None]) -> None:
        self.swap = swap
        self.undo = undo


def _head(path: str, most_bytes: int) -> bytes:
    """Returns the begin of a file; nothing if it is no file that can be read."""
    try:
        if not Path(path).is_file():  # a pipe would wait
            return b""
        with Path(path).open("rb") as file:
            return file.read(max(0, most_bytes))
    except (OSError, ValueError):
        return b""


def _others(folder: Path) -> dict[str, str]:
    """Returns the project's own modules beside its actions: all source of each top-level name."""
    found: dict[str, str] = {}
    for path in sorted(folder.rglob("*.py")):
        name = path.relative_to(folder).parts[0].removesuffix(".py")
        if name != PACKAGE:
            found[name] = found.get(name, "") + path.read_text(encoding="utf-8", errors="replace")
    return found


def _remove_modules(folder: Path, names: set[str]) -> dict[str, Any]:
    """Removes loaded modules of the folder, so that they are loaded again; returns them."""
    removed = {
        name: module
        for name, module in sys.modules.items()
        if name.partition(".")[0] in names
        and str(getattr(module, "__file__", None) or "").startswith(f"{folder}/")
    }
    for name in removed:
        del sys.modules[name]
    return removed
