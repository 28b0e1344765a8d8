"""Reads a project of JdeRobot's BT Studio, in any of its three layouts."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from translator.catalog import builtins
from translator.check import check
from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.importer import project_files, with_proposal
from translator.jderobot.graph import GraphOptions, read_graph
from translator.json_file import parse_json
from translator.project import Project, load
from translator.settings import Settings
from translator.stub import can_be_class, stub_source
from translator.text import bad_character, clean, is_clean

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.tree import Tree

MAIN_TREE = "MainTree"
_MAIN_FILES = ("code/trees/main.json", "trees/main.json", "graph.json", "code/graph.json")
_SUBTREE_FOLDERS = ("trees/subtrees/json/", "trees/subtrees/", "subtrees/json/", "subtrees/")
_ACTION_FOLDERS = ("code/actions/", "actions/")
ORDERS = ("bottom-to-top", "top-to-bottom")
_NEVER_REACHED = frozenset({"BT0114", "BT0118"})


@dataclass(frozen=True, slots=True)
class _Layout:
    """The places of a project's parts: folder, main graph, graphs of subtrees by name."""

    folder: str
    main: str
    subtrees: Mapping[str, str]


def is_jderobot_project(files: Mapping[str, bytes]) -> bool:
    """Returns whether the files look like a project of JdeRobot's BT Studio."""
    return _find_layout(files) is not None


def import_jderobot(files: Mapping[str, bytes], *, name: str = "", order: str = "") -> Project:
    """Converts a project of JdeRobot to a project of BT Studio; the actions do not change.

    Args:
        files: The files of the project, by path; they may all be in one folder.
        name: The name of the project, if its settings have none.
        order: The order of children, one of `ORDERS`; "" for that of the project's settings.

    Raises:
        TranslatorError: If there is no main graph, or it cannot be read.
    """
    layout = _find_layout(files)
    if layout is None:
        raise TranslatorError([diagnostic("BT0800", Place("graph.json"), files=", ".join(_MAIN_FILES))])
    found: list[Diagnostic] = []
    config = _read_config(files, layout.folder, found)
    used = order or _order_in(config, layout.folder, found)
    project = _imported(files, layout, config, used, name, found)
    if order or not (left_out := _never_reached(project)):
        return project
    other = ORDERS[used == ORDERS[0]]
    if _never_reached(_imported(files, layout, config, other, name, [])):
        return project
    better = diagnostic("BT0811", left_out.place, order=used, other=other, **left_out.values)
    return replace(project, diagnostics=(better, *project.diagnostics))


def _never_reached(project: Project) -> Diagnostic | None:
    """Returns the finding that a branch is never reached; that of the main tree if there are several."""
    found = [item for item in check(project) if item.code in _NEVER_REACHED]
    found.sort(key=lambda item: item.place.tree != project.settings.main_tree)
    return next(iter(found), None)


def _imported(  # noqa: PLR0913, PLR0917 - the parts of a project that was read
    files: Mapping[str, bytes],
    layout: _Layout,
    config: dict[str, Any],
    order: str,
    name: str,
    found: list[Diagnostic],
) -> Project:
    trees = _read_trees(files, layout, order, found)
    given = config.get("name")
    title = clean(given) if isinstance(given, str) and given.strip() else layout.folder.strip("/") or name
    settings = Settings(
        name=(title.rsplit("/", 1)[-1] or "Imported project")[:200],
        main_tree=next(iter(trees)),
        on_finish="repeat",
    )
    others = _other_files(files, layout)
    settings, proposed = with_proposal(settings, trees.values(), others)
    found.extend(proposed)
    result = project_files(settings, trees.values()) | others
    result.update(_stubs(trees, result))
    project = load(result)
    return replace(project, diagnostics=(*found, *project.diagnostics))


def _find_layout(files: Mapping[str, bytes]) -> _Layout | None:
    candidates = [
        (path.count("/"), _MAIN_FILES.index(main), path[: -len(main)], path)
        for path in files
        for main in _MAIN_FILES
        if (path == main or path.endswith(f"/{main}")) and b'"layers"' in files[path]
    ]
    if not candidates:
        return None
    _, _, folder, main = min(candidates)
    subtrees: dict[str, str] = {}
    for path in sorted(files):
        if not path.startswith(folder) or not path.endswith(".json") or path == main:
            continue
        inside = path[len(folder) :].removeprefix("code/")
        for subtree_folder in _SUBTREE_FOLDERS:
            rest = inside.removeprefix(subtree_folder)
            if rest != inside and "/" not in rest:
                subtrees.setdefault(PurePosixPath(path).stem, path)
                break
    return _Layout(folder, main, subtrees)


def _read_config(files: Mapping[str, bytes], folder: str, found: list[Diagnostic]) -> dict[str, Any]:
    path = f"{folder}config.json"
    if path not in files:
        return {}
    config, problem = parse_json(files[path], file=path)
    if problem is not None:
        found.append(problem)
    return config if isinstance(config, dict) else {}


def _order_in(config: dict[str, Any], folder: str, found: list[Diagnostic]) -> str:
    inner = config.get("config")
    order = inner.get("btOrder") if isinstance(inner, dict) else config.get("btOrder")
    if order in ORDERS:
        return str(order)
    if order is not None:
        found.append(diagnostic("BT0808", Place(f"{folder}config.json"), order=str(order)[:40]))
    return ORDERS[0]


def _read_trees(
    files: Mapping[str, bytes], layout: _Layout, order: str, found: list[Diagnostic]
) -> dict[str, Tree]:
    ids = _tree_ids(layout, found)
    main_id = MAIN_TREE
    while main_id in ids.values():
        main_id += "_"
    trees: dict[str, Tree] = {}
    graphs = [(main_id, layout.main), *((ids[name], path) for name, path in layout.subtrees.items())]
    for tree_id, path in graphs:
        tree, problems = read_graph(files[path], GraphOptions(tree_id, path, order == ORDERS[0], ids))
        found.extend(problems)
        if tree is not None:
            trees[tree_id] = tree
        elif path == layout.main:
            raise TranslatorError(found)
    return trees


def _tree_ids(layout: _Layout, found: list[Diagnostic]) -> dict[str, str]:
    """Returns the id of each subtree: its name, without characters that an id cannot have."""
    ids: dict[str, str] = {}
    for name, path in layout.subtrees.items():
        tree_id = name
        if bad_character(name) is not None or name in builtins() or name.lower() == "root":
            tree_id = re.sub(r"[^\w-]+", "_", name).strip("_") or "SubTree1"
            tree_id = f"{tree_id}Tree" if tree_id in builtins() or tree_id.lower() == "root" else tree_id
            found.append(diagnostic("BT0809", Place(path), name=clean(name), id=tree_id))
        while tree_id in ids.values():
            tree_id += "_"
        ids[name] = tree_id
    return ids


def _other_files(files: Mapping[str, bytes], layout: _Layout) -> dict[str, bytes]:
    """Returns the actions in BT Studio's folder, and all other files except graphs and settings as assets."""
    result: dict[str, bytes] = {}
    graphs = {layout.main, *layout.subtrees.values(), f"{layout.folder}config.json"}
    for path in sorted(files):
        if not path.startswith(layout.folder) or path in graphs or not is_clean(path):
            continue
        inside = path[len(layout.folder) :]
        for folder in _ACTION_FOLDERS:
            if inside.startswith(folder):
                result[f"actions/{inside[len(folder) :]}"] = files[path]
                break
        else:
            result[f"assets/{inside.removeprefix('assets/')}"] = files[path]
    return result


def _stubs(trees: Mapping[str, Tree], files: Mapping[str, bytes]) -> dict[str, bytes]:
    ports: dict[str, set[str]] = {}
    for tree in trees.values():
        for node in tree.nodes.values():
            if node.type not in builtins() and not node.children and can_be_class(node.type):
                ports.setdefault(node.type, set()).update(node.ports)
    return {
        f"actions/{name}.py": stub_source(name, None, ports[name]).encode()
        for name in sorted(ports)
        if f"actions/{name}.py" not in files
    }
