"""Opens any input: a project folder or zip, a diagram, an XML file, a project of JdeRobot."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from translator.archive import read_file, read_folder, read_zip
from translator.diagnostic import Place, TranslatorError, diagnostic
from translator.diagram import restore
from translator.importer import from_files, from_xml, project_files
from translator.jderobot.graph import looks_like_graph
from translator.jderobot.project import import_jderobot, is_jderobot_project
from translator.jderobot.self_contained import is_old_form, read_old_form
from translator.project import Project, load
from translator.settings import PROJECT_FILE, Settings
from translator.xml.includes import SUFFIXES, tree_files
from translator.xml.source import repair_source

if TYPE_CHECKING:
    from collections.abc import Mapping


def open_path(  # noqa: PLR0913 - each is a separate choice, and keyword-only
    path: Path,
    *,
    actions: Path | None = None,
    stubs: bool = True,
    repair: bool = False,
    main: str = "",
    order: str = "",
) -> Project:
    """Opens a project from disk.

    Args:
        path: A folder, a zip, a diagram (`.json`) or a tree (`.xml`, `.btproj`).
        actions: A folder with the actions of a diagram or a tree.
        stubs: Whether actions that are missing get a stub.
        repair: Whether bare `&` and `<` in attributes of XML are escaped.
        main: The main tree of XML, or the file that holds it; "" if it is found out.
        order: The order of children on the canvas of a project of JdeRobot; "" for that of its settings.

    Raises:
        TranslatorError: If nothing can be read.
    """
    sources = _read_actions(actions) if actions is not None else {}
    if path.is_dir():
        files, name = read_folder(path), path.resolve().name
        return open_files(
            files, name=name, actions=sources, stubs=stubs, repair=repair, main=main, order=order
        )
    raw = read_file(path)
    if path.suffix.lower() == ".zip":
        files = read_zip(raw, file=str(path))
        return open_files(
            files, name=path.stem, actions=sources, stubs=stubs, repair=repair, main=main, order=order
        )
    if path.suffix.lower() == ".json":
        return _open_diagram(path, raw, sources, order)
    return _open_tree(path, raw, sources, stubs=stubs, repair=repair, main=main)


def open_files(  # noqa: PLR0913 - each is a separate choice, and keyword-only
    files: Mapping[str, bytes],
    *,
    name: str = "",
    actions: Mapping[str, bytes] | None = None,
    stubs: bool = True,
    repair: bool = False,
    main: str = "",
    order: str = "",
) -> Project:
    """Opens a project of any kind from its files, by path.

    Raises:
        TranslatorError: If nothing can be read.
    """
    sources = actions or {}
    if repair:
        files = _repaired(files)
    if is_jderobot_project(files):
        return import_jderobot(files, name=name, order=order)
    if PROJECT_FILE in files or any(path.startswith("trees/") and path.endswith(".json") for path in files):
        return load({**files, **{f"actions/{file}": raw for file, raw in sources.items()}})
    entries = tree_files(files)
    if not entries:
        raise TranslatorError([diagnostic("BT0923", Place(name or ".", line=1, column=1))])
    if main in entries:
        entries, main = [main], ""
    beside = {
        PurePosixPath(path).name: raw
        for path, raw in files.items()
        if path.startswith("actions/") and path.endswith(".py")
    }
    sources = beside | dict(sources)
    if len(entries) == 1:
        return open_tree(
            files[entries[0]], file=entries[0], included=files, actions=sources, stubs=stubs, main=main
        )
    return from_files(entries, _of_xml(files), name=name, actions=sources, stubs=stubs, main=main)


def open_tree(  # noqa: PLR0913 - the arguments of `from_xml`
    raw: bytes,
    *,
    file: str,
    included: Mapping[str, bytes] | None = None,
    actions: Mapping[str, bytes] | None = None,
    stubs: bool = True,
    main: str = "",
    places: str = "imports/",
) -> Project:
    """Opens one XML document of any form; the arguments are those of `from_xml`.

    Raises:
        TranslatorError: If the document cannot be read.
    """
    if is_old_form(raw):
        return read_old_form(raw, file=file)
    others = _of_xml(included or {})
    return from_xml(raw, file=file, included=others, actions=actions, stubs=stubs, main=main, places=places)


def _of_xml(files: Mapping[str, bytes]) -> dict[str, bytes]:
    return {path: data for path, data in files.items() if path.lower().endswith(SUFFIXES)}


def _read_actions(folder: Path) -> dict[str, bytes]:
    if not folder.is_dir():
        raise TranslatorError([diagnostic("BT0925", Place(str(folder), line=1, column=1))])
    return {path: raw for path, raw in read_folder(folder).items() if path.endswith(".py")}


def _open_diagram(path: Path, raw: bytes, sources: Mapping[str, bytes], order: str) -> Project:
    """Opens a diagram: with its project if it is in a project folder, otherwise alone."""
    if looks_like_graph(raw):
        return import_jderobot({"graph.json": raw} | _beside(path), name=path.stem, order=order)
    tree, found = restore(raw, file=str(path))
    if tree is None:
        raise TranslatorError(found)
    folder = path.resolve().parent.parent
    if path.resolve().parent.name == "trees" and (folder / PROJECT_FILE).is_file():
        files = read_folder(folder) | {f"actions/{name}": data for name, data in sources.items()}
        project = load(files)
        settings = project.settings.model_copy(update={"main_tree": tree.id})
        return replace(project, settings=settings)
    files = project_files(Settings(name=tree.id, main_tree=tree.id), [])
    files |= {f"trees/{path.name}": raw, **{f"actions/{name}": data for name, data in sources.items()}}
    return load(files)


def _beside(path: Path) -> dict[str, bytes]:
    config = path.with_name("config.json")
    return {"config.json": read_file(config)} if config.is_file() else {}


def _repaired(files: Mapping[str, bytes]) -> dict[str, bytes]:
    return {
        path: repair_source(raw) if path.lower().endswith(SUFFIXES) else raw for path, raw in files.items()
    }


def _open_tree(  # noqa: PLR0913 - the choices of `open_path`
    path: Path, raw: bytes, sources: Mapping[str, bytes], *, stubs: bool, repair: bool, main: str
) -> Project:
    folder = path.resolve().parent
    included = {
        item.relative_to(folder).as_posix(): read_file(item)
        for suffix in SUFFIXES
        for item in sorted(folder.rglob(f"*{suffix}"))[:1000]
        if b"<include" in raw and item.is_file() and not item.is_symlink()
    }
    if repair:
        raw, included = repair_source(raw), _repaired(included)
    if not sources and (folder / "actions").is_dir():
        sources = _read_actions(folder / "actions")
    places = "" if path.parent == Path() else f"{path.parent.as_posix()}/"
    try:
        return open_tree(
            raw, file=path.name, included=included, actions=sources, stubs=stubs, main=main, places=places
        )
    except TranslatorError as error:
        found = [item.moved(file=f"{places}{item.place.file}") for item in error.diagnostics]
        raise TranslatorError(found) from None
