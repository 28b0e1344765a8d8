"""Behaviour tests of a project: finds and reads `tests/*.test.yaml`, and makes the job that runs them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from translator.action_returns import returned_statuses, returns_of
from translator.check import check
from translator.diagnostic import errors_in
from translator.enums import enum_lines
from translator.shared_modules import sources_of
from translator.xml.write import write_document
from translator.yaml_text import YamlError, YamlText, read_yaml

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from translator.action import ActionModel
    from translator.diagnostic import Diagnostic as TreeDiagnostic
    from translator.project import Project
    from tree_gardener.errors import Diagnostic

FOLDER = "tests/"
ENDINGS = (".test.yaml", ".test.yml")
_KINDS = {"condition": "Condition", "control": "control", "decorator": "decorator"}


def paths_of_tests(files: Mapping[str, bytes]) -> list[str]:
    """Returns the paths of the files of behaviour tests."""
    return sorted(path for path in files if path.startswith(FOLDER) and path.endswith(ENDINGS))


def errors_before_tests(
    project: Project, checked: Sequence[TreeDiagnostic] | None = None
) -> tuple[TreeDiagnostic, ...]:
    """Returns the errors that keep the trees from being tested.

    A folder of trees without a main one, such as a library, can be tested if its tests name their trees.

    Args:
        project: the project.
        checked: what `check` found in it; without it, the project is checked now.
    """
    errors = errors_in(check(project) if checked is None else checked)
    return tuple(found for found in errors if found.code != "BT0100" or not project.trees)


def to_job(project: Project, *, real: bool = False) -> tuple[dict[str, Any], list[Diagnostic]]:
    """Returns the tests of a project as a job, and the files that cannot be read.

    The job is what `tree_gardener.testing.job.Job.from_json` reads. No Python of the project is run for it.

    Args:
        project: the project.
        real: whether the job takes the sources of the actions along, for leaves that are `real`.
    """
    read, problems = read_files(project.files)
    files = [
        {
            "name": path,
            "document": text.value,
            "places": [[list(part), *place] for part, place in text.places.items()],
        }
        for path, text in read.items()
    ]
    job = {
        "format": "bt-studio/behaviour-tests",
        "version": 1,
        "tick_hz": float(project.settings.tick_hz),
        "on_error": project.settings.on_error,
        "files": files,
        "nodes": {name: leaf_model(action) for name, action in sorted(project.actions.items())},
        "ports": {
            tree.id: {port.name: port.default for port in tree.ports if port.default is not None}
            for tree in project.trees.values()
        },
        "xml": write_document(project, after=enum_lines(project.enums)),
        "sources": sources_of(project) if real else None,
    }
    return job, problems


def read_files(files: Mapping[str, bytes]) -> tuple[dict[str, YamlText], list[Diagnostic]]:
    """Returns the documents of the files of tests, and the files that are no YAML."""
    from tree_gardener.errors import Diagnostic  # noqa: PLC0415 - the engine loads py_trees

    read: dict[str, YamlText] = {}
    problems: list[Diagnostic] = []
    for path in paths_of_tests(files):
        try:
            read[path] = read_yaml(files[path])
        except YamlError as error:
            problems.append(
                Diagnostic("TG900", error.message, file=path, line=error.line, column=error.column)
            )
    return read, problems


def leaf_model(action: ActionModel) -> dict[str, Any]:
    """Returns the model of an action for tests, in the form that the engine's `LeafModel.to_json` writes."""
    return {
        "kind": _KINDS.get(action.kind)
        or ("SyncAction" if returns_of(action.source, action.name).is_sync else "Action"),
        "ports": [[port.direction, port.name, port.type, port.default] for port in action.ports],
        "open": action.open,
        "returns": sorted(returned_statuses(action.source, action.name)),
        "children": [action.min_children, action.max_children],
    }
