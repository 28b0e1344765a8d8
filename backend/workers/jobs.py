"""The jobs of a worker: pure functions of files and texts, without Django.

If the translator refuses the input, the answer is normal: `{"refused": [diagnostic, …]}`.
"""

from __future__ import annotations

import base64
import re
from typing import TYPE_CHECKING, Any, Final

from backend.workers import differences, thumbnails, zips

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from translator import Tree
    from translator.tree_text import TreeText

_OWN_ROBOT: Final = re.compile(r"robots/[^/]+/robot\.yaml")

Files = dict[str, bytes]
Answer = dict[str, Any]


def warm_up() -> None:
    """Imports the modules that the first job needs."""
    import translator  # noqa: PLC0415 - the web server, too, imports this module
    from tree_gardener.lazy import import_names  # noqa: PLC0415 - as above

    import_names(translator)


def report(files: Files) -> Answer:
    """Returns the problems and the actions of a project."""
    import translator  # noqa: PLC0415 - as above

    try:
        project = translator.load(files)
    except translator.TranslatorError as error:
        return {"diagnostics": _told(error), "actions": []}
    diagnostics = [found.to_json() for found in translator.check(project)]
    return {"diagnostics": diagnostics, "actions": [action.to_json() for action in project.actions.values()]}


def behaviour_tests(files: Files, *, with_job: bool = False) -> Answer:
    """Returns the results of the project's behaviour tests that need no Python of it."""
    from backend.workers.behaviours import run_tests  # noqa: PLC0415 - it loads the engine

    return run_tests(files, with_job=with_job)


def run_coverage(files: Files, *, seen: dict[str, str]) -> Answer:
    """Returns the coverage of the project's trees by runs of it."""
    from backend.workers import behaviours  # noqa: PLC0415 - it loads the engine

    return behaviours.run_coverage(files, seen)


def xml(files: Files, *, self_contained: bool) -> Answer:
    """Returns the tree as BT.CPP XML."""
    import translator  # noqa: PLC0415

    project = translator.load(files)
    return {"text": translator.self_contained(project) if self_contained else translator.to_xml(project)}


def app(files: Files, *, universe: str, built_in: bytes | None, revision: int) -> Answer:
    """Returns the data of the command with which the browser runs the project in the executor.

    Args:
        files: the files of the project.
        universe: the name of the universe; "" for the project's own choice.
        built_in: the document of the built-in universe of that name, if the project has none.
        revision: the revision of the project.
    """
    import translator  # noqa: PLC0415

    project = translator.load(files)
    settings = project.settings
    return {
        "app_zip_base64": base64.b64encode(translator.to_app_zip(project)).decode("ascii"),
        "tick_hz": settings.tick_hz,
        "on_finish": settings.on_finish,
        "on_error": settings.on_error,
        "time": settings.time,
        "universe": _universe(files, universe or settings.universe, built_in),
        "robot": settings.robot,
        "revision": revision,
    }


def _universe(files: Files, name: str, built_in: bytes | None) -> str | dict[str, str]:
    """Returns a universe of the project as a document with its assets, or the id of a built-in one.

    If the project has custom robots, a built-in universe is also returned as a document, which includes them.
    """
    from translator.diagnostic import Place, TranslatorError, diagnostic  # noqa: PLC0415

    path = f"universes/{name}.yaml"
    document = files.get(path)
    if document is None and any(_OWN_ROBOT.fullmatch(path) for path in files):
        document = built_in
    if document is None:
        return name
    try:
        text = document.decode("utf-8")
    except UnicodeDecodeError as error:
        raise TranslatorError([diagnostic("BT0002", Place(path), byte=error.start)]) from error
    assets = {p: data for p, data in files.items() if p.startswith(("assets/", "robots/", "universes/"))}
    packed = base64.b64encode(zips.pack(assets)).decode("ascii")
    return {"document": text, "assets_zip_base64": packed, "file": path}


def app_zip(files: Files) -> Answer:
    """Returns the app for the manager as a zip."""
    import translator  # noqa: PLC0415

    return {"zip": translator.to_app_zip(translator.load(files))}


def package(files: Files, *, name: str | None) -> Answer:
    """Returns a zip of the ROS 2 package and of the engine's package."""
    import translator  # noqa: PLC0415

    made = translator.to_ros2_package(translator.load(files), name=name)
    return {"name": made.name, "zip": made.to_zip()}


def package_preview(files: Files, *, name: str | None) -> Answer:
    """Returns the files of the ROS 2 package."""
    import translator  # noqa: PLC0415

    made = translator.to_ros2_package(translator.load(files), name=name)
    return {
        "name": made.name,
        "files": [{"path": path, "size": len(data)} for path, data in sorted(made.files.items())],
        "manifest": made.files.get(f"{made.name}/package.xml", b"").decode(),
        "diagnostics": [found.to_json() for found in made.diagnostics],
    }


def cpp_package(files: Files, *, name: str | None) -> Answer:
    """Returns a zip of the package for BehaviorTree.CPP."""
    import translator  # noqa: PLC0415

    made = translator.to_cpp_package(translator.load(files), name=name)
    return {"name": made.name, "zip": made.to_zip()}


def models(files: Files) -> Answer:
    """Returns the models of the project's nodes."""
    import translator  # noqa: PLC0415

    return {"text": translator.to_models_xml(translator.load(files))}


def xsd(files: Files) -> Answer:
    """Returns the XML Schema of documents with the project's nodes."""
    import translator  # noqa: PLC0415

    return {"text": translator.to_xsd(translator.load(files))}


def opened(files: Files, *, name: str, repair: bool) -> Answer:
    """Returns a new project, made from a project of JdeRobot or Groot2, or from BT.CPP XML.

    `proposal` names the universe that the project got, and the topics that ask for it; without such topics it
    is null. `repair` escapes bare `&` and `<` in attributes of XML; the client offers it if the XML cannot be
    read.
    """
    import translator  # noqa: PLC0415

    project = translator.open_files(files, name=name, repair=repair)
    proposals = (dict(found.values) for found in project.diagnostics if found.code == "BT0742")
    return {"files": dict(project.files), "proposal": next(proposals, None)}


def inspect(source: str, *, filename: str) -> Answer:
    """Returns the declarations in the source of an action."""
    import translator  # noqa: PLC0415

    return translator.inspect_action(source, filename).to_json()


def write_tree(diagram: str, *, base: str, ids: Sequence[str]) -> Answer:
    """Returns a diagram as XML. With an earlier text, only the parts that differ are changed in it."""
    from translator.tree_text import write_tree_text  # noqa: PLC0415

    return _text(write_tree_text(_tree(diagram), base=base, ids=ids))


def read_tree(xml: str, *, diagram: str) -> Answer:
    """Returns the diagram of an edited XML text; `diagram` is the earlier state of the diagram.

    An incomplete text is a normal case: the answer has no diagram, but findings with the reasons.
    """
    from translator import TranslatorError  # noqa: PLC0415
    from translator.diagram import diagram_text  # noqa: PLC0415
    from translator.tree_text import read_tree_text  # noqa: PLC0415

    now = _tree(diagram)
    try:
        found = read_tree_text(xml, now)
    except TranslatorError as error:
        return {"xml": xml, "ranges": [], "diagram": None, "diagnostics": _told(error)}
    told = [item.to_json() for item in found.diagnostics]
    return _text(found.text) | {"diagram": diagram_text(found.tree), "diagnostics": told}


def pack(files: Files) -> Answer:
    """Returns files as a zip; equal files give equal bytes."""
    return {"zip": zips.pack(files)}


def diff(older: Mapping[str, str | None], newer: Mapping[str, str | None]) -> Answer:
    """Returns the differences of files as text; None stands for a file that is not text."""
    return {"files": differences.diff(older, newer)}


def thumbnail(
    picture: bytes,
    boxes: Sequence[Sequence[float]],
    trail: Sequence[Sequence[float]],
    rows: Sequence[Sequence[int]],
) -> Answer:
    """Returns a small picture of a run."""
    return thumbnails.thumbnail(picture, boxes, trail, rows)


def _tree(diagram: str) -> Tree:
    from translator import TranslatorError  # noqa: PLC0415
    from translator.diagram import restore  # noqa: PLC0415

    tree, found = restore(diagram, file="diagram.json")
    if tree is None:
        raise TranslatorError(found)
    return tree


def _text(text: TreeText) -> Answer:
    ranges = [{"node": r.node, "start": r.start, "open_end": r.open_end, "end": r.end} for r in text.ranges]
    return {"xml": text.xml, "ranges": ranges}


def _told(error: Any) -> list[Any]:
    return [found.to_json() for found in error.diagnostics]


def _refusing(job: Callable[..., Answer]) -> Callable[..., Answer]:
    def answer(**arguments: Any) -> Answer:
        from translator import TranslatorError  # noqa: PLC0415

        try:
            return job(**arguments)
        except TranslatorError as error:
            return {"refused": _told(error)}

    return answer


JOBS: Final[dict[str, Callable[..., Answer]]] = {
    job.__name__: _refusing(job)
    for job in (
        *(
            report,
            behaviour_tests,
            run_coverage,
            xml,
            app,
            app_zip,
            package,
            package_preview,
            cpp_package,
            models,
            xsd,
            opened,
        ),
        *(inspect, write_tree, read_tree, pack, diff, thumbnail),
    )
}
