"""A project in memory: settings, trees, actions and files, read once and never changed."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, TypeVar
from weakref import WeakKeyDictionary

from translator.action import KEPT_BYTES, ActionModel, inspect_action
from translator.catalog import NodeModel, PortModel, builtins
from translator.diagnostic import Diagnostic, Place, Severity, TranslatorError, diagnostic
from translator.diagram import diagram_path, restore
from translator.enums import ENUMS_FILE, read_enums, with_enums
from translator.foreign import without_tools
from translator.limits import DIAGRAM_BYTES_PER_PROJECT, TREES_PER_PROJECT, megabytes, oversize
from translator.settings import PROJECT_FILE, Settings, read_settings
from translator.text import bad_character
from translator.tree import used_types
from translator.xml.read import read_document

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping

    from translator.tree import Tree


_File = TypeVar("_File")

WORLD_FOLDERS = ("evaluations/", "universes/", "robots/", "assets/")
"""Folders that decide in which worlds a project is evaluated, and by which judge."""


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class Project:
    """A project, the input of a translation. `diagnostics` are those of reading; `check` adds others."""

    settings: Settings
    trees: Mapping[str, Tree]
    actions: Mapping[str, ActionModel]
    files: Mapping[str, bytes] = field(default_factory=dict, repr=False)
    diagnostics: tuple[Diagnostic, ...] = ()
    enums: Mapping[str, Mapping[str, int]] = field(default_factory=dict)

    @property
    def main(self) -> Tree | None:
        """The main tree; None if the project does not have it."""
        return self.trees.get(self.settings.main_tree)

    def model(self, type_: str) -> NodeModel | None:
        """Returns the model of a type of node, built in or an action; None if it cannot run."""
        if (model := builtins().get(type_)) is not None:
            return model
        if (action := self.actions.get(type_)) is not None:
            return action_node_model(action)
        return None

    def imported_model(self, type_: str) -> NodeModel | None:
        """Returns the model that an imported file has of a node type that cannot run here, or None."""
        if self not in _imported:
            _imported[self] = _imported_models(self.files)
        return _imported[self].get(type_)

    def known_types(self) -> list[str]:
        """Returns the types that a diagram of this project may use."""
        return [*builtins(), *self.actions]

    def with_tree(self, tree: Tree) -> Project:
        """Returns the project with a tree added or replaced."""
        return replace(self, trees={**self.trees, tree.id: tree})


_imported: WeakKeyDictionary[Project, dict[str, NodeModel]] = WeakKeyDictionary()


def action_node_model(action: ActionModel) -> NodeModel:
    """Returns an action, or a control node or decorator of the project, as a kind of node."""
    ports: dict[str, PortModel] = {port.name: port for port in action.ports}
    return NodeModel(
        *(action.name, action.kind, action.min_children, action.max_children, ports),
        open=action.open,
        summary=action.doc.partition("\n")[0],
    )


def load(files: Mapping[str, bytes]) -> Project:
    """Reads a project from its files, by path from its folder.

    Invalid content never raises: it is repaired or left out, and reported in `diagnostics`.

    Raises:
        TranslatorError: If the files are not a project: they hold neither `project.json` nor a diagram.
    """
    files = without_tools(files)
    found: list[Diagnostic] = []
    if PROJECT_FILE not in files and not any(_is_diagram(path) for path in files):
        raise TranslatorError([diagnostic("BT0008", Place(PROJECT_FILE))])
    settings = Settings()
    if PROJECT_FILE in files:
        settings, problems = _read_settings(files[PROJECT_FILE])
        found.extend(problems)
    trees = {} if _are_too_large(files, found) else _load_trees(files, found)
    found.extend(oversize(trees.values(), Place(PROJECT_FILE, line=1)))
    if PROJECT_FILE not in files and settings.main_tree not in trees and len(trees) == 1:
        settings = settings.model_copy(update={"main_tree": next(iter(trees))})
    enums = _load_enums(files, found)
    actions = _load_actions(files, used_types(trees.values()), enums, found)
    return Project(settings, trees, actions, dict(files), tuple(found), enums)


def in_worlds_of(judge: Mapping[str, _File], files: Mapping[str, _File]) -> dict[str, _File]:
    """Returns files of a project, with the evaluations, universes, robots and assets of another version."""
    kept = {path: data for path, data in files.items() if not path.startswith(WORLD_FOLDERS)}
    return kept | {path: data for path, data in judge.items() if path.startswith(WORLD_FOLDERS)}


def assemble(settings: Settings, trees: Iterable[Tree], files: Mapping[str, bytes]) -> Project:
    """Makes the project that `load` would read from `files`, from known settings and trees."""
    files = without_tools(files)
    found: list[Diagnostic] = []
    placed = {tree.id: tree for tree in trees}
    enums = _load_enums(files, found)
    actions = _load_actions(files, used_types(placed.values()), enums, found)
    return Project(settings, placed, actions, dict(files), tuple(found), enums)


def _restore(raw: bytes, path: str) -> tuple[Tree | None, tuple[Diagnostic, ...]]:
    # As with actions: a project is read again after each save, and mostly one of its files has changed.
    return _restored(raw, path) if len(raw) <= KEPT_BYTES else restore(raw, file=path)


def _read_settings(raw: bytes) -> tuple[Settings, tuple[Diagnostic, ...]]:
    return _settings_read(raw) if len(raw) <= KEPT_BYTES else read_settings(raw)


_restored = lru_cache(maxsize=256)(lambda raw, path: restore(raw, file=path))
_settings_read = lru_cache(maxsize=256)(read_settings)
_enums_read = lru_cache(maxsize=256)(read_enums)


def _is_diagram(path: str) -> bool:
    return path.startswith("trees/") and path.endswith(".json")


def _are_too_large(files: Mapping[str, bytes], found: list[Diagnostic]) -> bool:
    """Returns whether the diagrams are too many or too large, so that none of them is read."""
    sizes = [len(raw) for path, raw in files.items() if _is_diagram(path)]
    place = Place(PROJECT_FILE, line=1)
    if sum(sizes) > DIAGRAM_BYTES_PER_PROJECT:
        size, limit = megabytes(sum(sizes)), megabytes(DIAGRAM_BYTES_PER_PROJECT)
        found.append(diagnostic("BT0019", place, size=size, limit=limit))
    elif len(sizes) > TREES_PER_PROJECT:
        size, limit = f"{len(sizes)} trees", f"{TREES_PER_PROJECT} trees"
        found.append(diagnostic("BT0019", place, size=size, limit=limit))
    else:
        return False
    return True


def _load_trees(files: Mapping[str, bytes], found: list[Diagnostic]) -> dict[str, Tree]:
    read: list[Tree] = []
    for path in sorted(files):
        if _is_diagram(path):
            tree, problems = _restore(files[path], path)
            found.extend(problems)
            read += [tree] if tree is not None else []
    trees: dict[str, Tree] = {}
    for tree in sorted(read, key=lambda tree: tree.file != diagram_path(tree.id)):
        place = Place(tree.file, tree=tree.id)
        if tree.id in trees:
            found.append(diagnostic("BT0015", place, id=tree.id, other=trees[tree.id].file))
            continue
        if tree.file != diagram_path(tree.id):
            found.append(diagnostic("BT0016", place, id=tree.id, file=PurePosixPath(tree.file).stem))
        trees[tree.id] = tree
    return trees


def action_paths(files: Mapping[str, bytes]) -> Iterator[tuple[str, str]]:
    """Yields name and path of each action file."""
    for path in sorted(files):
        parts = PurePosixPath(path).parts
        if (
            len(parts) == 2
            and parts[0] == "actions"
            and path.endswith(".py")
            and not parts[1].startswith("_")
        ):
            yield parts[1][:-3], path


def _is_shared_module(model: ActionModel) -> bool:
    """Returns whether a file is a module that actions import.

    It has the name of a module, and no class of an action.
    """
    return model.name[:1].islower() and any(item.code in {"BT0602", "BT0607"} for item in model.diagnostics)


def _load_enums(files: Mapping[str, bytes], found: list[Diagnostic]) -> dict[str, dict[str, int]]:
    if ENUMS_FILE not in files:
        return {}
    raw = files[ENUMS_FILE]
    enums, problems = (_enums_read if len(raw) <= KEPT_BYTES else read_enums)(raw)
    found.extend(problems)
    return enums


def _load_actions(
    files: Mapping[str, bytes],
    used: Collection[str],
    enums: Mapping[str, Mapping[str, int]],
    found: list[Diagnostic],
) -> dict[str, ActionModel]:
    actions = {}
    for name, path in action_paths(files):
        try:
            source = files[path].decode("utf-8-sig")
        except UnicodeDecodeError as error:
            place = Place(path, line=error.object.count(b"\n", 0, error.start) + 1)
            found.append(diagnostic("BT0002", place, byte=error.start))
            continue
        model = inspect_action(source, path)
        if (bad := bad_character(name)) is not None:
            found.append(diagnostic("BT0608", Place(path, line=1), name=name, character=bad))
        if name in builtins():
            found.append(diagnostic("BT0609", Place(path, line=model.line), name=name))
            continue
        if name not in used and _is_shared_module(model):
            continue
        found.extend(model.diagnostics if name in used else map(_of_unused, model.diagnostics))
        actions[name] = with_enums(model, enums) if enums else model
    return actions


def _of_unused(found: Diagnostic) -> Diagnostic:
    """Returns a finding about an action that no tree uses: no run refuses its kind."""
    return replace(found, severity=Severity.WARNING) if found.code == "BT0606" else found


def _imported_models(files: Mapping[str, bytes]) -> dict[str, NodeModel]:
    """Returns the models in imported files of nodes that are neither built in nor actions."""
    models: dict[str, NodeModel] = {}
    for path in sorted(files):
        if not path.startswith("imports/"):
            continue
        with contextlib.suppress(TranslatorError):
            models.update(read_document(files[path], file=path).models)
    return {type_: model for type_, model in models.items() if model.kind != "subtree"}
