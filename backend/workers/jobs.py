"""The jobs of a worker: pure functions of files and texts, without Django.

If the translator refuses the input, the answer is normal: `{"refused": [diagnostic, …]}`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from backend.workers import bundles, differences, offered, thumbnails, zips

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from translator import Tree
    from translator.nav2.distributions import Distribution
    from translator.tree_text import TreeText

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
    from translator.nav2.models import distribution_for  # noqa: PLC0415 - as above

    try:
        project = translator.load(files)
    except translator.TranslatorError as error:
        return {"diagnostics": _told(error), "actions": [], "ros_distro": None}
    checked = translator.check(project)
    diagnostics = [found.to_json() for found in checked]
    diagnostics += _programs(files)
    if any(path.startswith("tests/") for path in files):
        from backend.workers.behaviours import problems  # noqa: PLC0415 - it loads the engine

        diagnostics += problems(project, checked)
    return {
        "diagnostics": diagnostics,
        "actions": [action.to_json() for action in project.actions.values()],
        "ros_distro": distribution_for(project),
    }


def changed_distribution(files: Files, *, ros_distro: Distribution) -> Answer:
    """Returns the files of a project for another ROS distribution, and what its Nav2 lacks."""
    from translator.nav2.change import changed  # noqa: PLC0415 - as above

    change = changed(files, ros_distro)
    written = [(path, None if raw is None else raw.decode()) for path, raw in change.files.items()]
    return {
        "files": [{"path": path, "content": content} for path, content in written],
        "lacks": [str(lack) for lack in change.lacks],
        "kept": change.kept,
    }


def _programs(files: Files) -> list[Answer]:
    """Returns a note about each file of a robot that has macros: these run in no worker."""
    from translator.diagnostic import Place, diagnostic  # noqa: PLC0415 - as above

    paths = sorted(path for path in files if path.startswith("robots/") and path.endswith(".xacro"))
    mains = [path for path in paths if f"{'/'.join(path.split('/')[:2])}/robot.yaml" in files]
    return [diagnostic("BT0915", Place(path), file=path).to_json() for path in mains]


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


def models(files: Files) -> Answer:
    """Returns the models of the project's nodes."""
    import translator  # noqa: PLC0415

    return {"text": translator.to_models_xml(translator.load(files))}


def xsd(files: Files) -> Answer:
    """Returns the XML Schema of documents with the project's nodes."""
    import translator  # noqa: PLC0415

    return {"text": translator.to_xsd(translator.load(files))}


ASK: Final = "ask"
"""The order of an import whose user is asked where the project's own order leaves a branch out."""


def opened(files: Files, *, name: str, repair: bool, main: str = "", order: str = "") -> Answer:
    """Returns a new project, made from a project of JdeRobot or Groot2, or from BT.CPP XML.

    `proposal` names the universe that the project got, and the topics that ask for it; without such topics it
    is null. `repair` escapes bare `&` and `<` in attributes of XML; the client offers it if the XML cannot be
    read. `main` is the main tree, or its file, which the client asks for if several could be. `order` is that
    of children on JdeRobot's canvas; with `ask`, an own order that leaves a branch out is refused (BT0811).
    """
    import translator  # noqa: PLC0415

    used = "" if order == ASK else order
    project = translator.open_files(files, name=name, repair=repair, main=main, order=used)
    left_out = [found for found in project.diagnostics if found.code == "BT0811"]
    if order == ASK and left_out:
        raise translator.TranslatorError(left_out)
    proposals = (dict(found.values) for found in project.diagnostics if found.code == "BT0742")
    return {"files": dict(project.files), "proposal": next(proposals, None)}


def inspect(source: str, *, filename: str) -> Answer:
    """Returns the declarations in the source of an action."""
    import translator  # noqa: PLC0415
    from translator.check.sources import source_findings  # noqa: PLC0415

    action = translator.inspect_action(source, filename)
    return replace(action, diagnostics=source_findings(action)).to_json()


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
            bundles.bundle,
            bundles.package_preview,
            models,
            xsd,
            opened,
        ),
        *(changed_distribution, inspect, write_tree, read_tree, pack, diff, thumbnail, offered.uses),
    )
} | {kind: _refusing(bundles.whole(kind)) for kind in bundles.KINDS}
