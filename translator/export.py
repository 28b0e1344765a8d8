"""Writes a project as XML: plain, or with the actions inside."""

from __future__ import annotations

import contextlib
import hashlib
from typing import TYPE_CHECKING

from translator.action import ActionModel, source_text
from translator.check import check
from translator.diagnostic import TranslatorError, errors_in
from translator.enums import enum_lines
from translator.importer import main_tree_of
from translator.shared_modules import shared_modules
from translator.tree import reachable_trees, used_types
from translator.xml.escape import attribute, cdata
from translator.xml.includes import Reading
from translator.xml.patch import patch_document
from translator.xml.read import Document, read_document
from translator.xml.write import ordered_trees, write_document

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.project import Project


def to_xml(project: Project) -> str:
    """Returns the project's trees as one BehaviorTree.CPP v4 document.

    A project that was imported from one XML file returns that file; the bytes of unchanged parts are the
    same. Errors that only prevent it from running in BT Studio do not prevent its export.

    Raises:
        TranslatorError: If the project has errors; its `diagnostics` name them.
    """
    documents = source_documents(project)
    if len(documents) == 1:
        return documents[0].source.decoded(_patched(documents[0], project, documents))
    if documents:
        return write_document(project)
    require_sound(project, elsewhere=True)
    return write_document(project)


def export_files(project: Project) -> dict[str, bytes]:
    """Returns the files to write to disk: the imported files with their changes, or one `<name>.xml`.

    Raises:
        TranslatorError: If the project has errors; its `diagnostics` name them.
    """
    documents = source_documents(project)
    if not documents:
        return {f"{project.settings.main_tree}.xml": to_xml(project).encode()}
    return {
        document.file.removeprefix("imports/"): _patched(document, project, documents)
        for document in documents
    }


def source_documents(project: Project) -> list[Document]:
    """Returns the imported XML files of a project, the one that includes the others first.

    They are without the trees that a tree of the same ID in another file replaces: these stay as they are.
    """
    files = {path: raw for path, raw in project.files.items() if path.startswith("imports/")}
    reading = Reading(files)
    for path in sorted(files):
        if path.endswith((".xml", ".btproj")):
            with contextlib.suppress(TranslatorError):
                reading.documents[path] = read_document(files[path], file=path)
    replaced = reading.replaced()
    for document in reading.documents.values():
        document.trees = [item for item in document.trees if (document.file, item.tree.id) not in replaced]
    targets = (
        reading.target(path, element)
        for path, document in reading.documents.items()
        for element in document.includes
    )
    included = set(targets)
    return sorted(reading.documents.values(), key=lambda document: document.file in included)


def _patched(document: Document, project: Project, documents: list[Document]) -> bytes:
    known = {item.tree.id for other in documents for item in other.trees}
    is_first = document is documents[0]
    added = [tree for tree in ordered_trees(project) if is_first and tree.id not in known and tree.root]
    named, taken = main_tree_of(documents)
    main = project.settings.main_tree
    is_changed = main != taken or (not named and len(project.trees) > 1 and set(project.trees) != known)
    names_it = bool(document.main) or (is_first and not named)
    return patch_document(document, project, added=added, main=main if is_changed and names_it else None)


def self_contained(project: Project) -> str:
    """Returns the document with the source of each used action, so that one file is enough to run it.

    Raises:
        TranslatorError: If the project has errors; its `diagnostics` name them.
    """
    require_sound(project)
    return write_self_contained(project)


def require_sound(project: Project, *, elsewhere: bool = False) -> None:
    """Raises `TranslatorError` if the checks find an error.

    What runs `elsewhere` may import packages that are not here.
    """
    errors = [found for found in errors_in(check(project)) if not (elsewhere and found.code == "BT0642")]
    if errors:
        raise TranslatorError(errors)


def used_actions(project: Project) -> list[ActionModel]:
    """Returns the actions that some tree uses, by name."""
    used = used_types(project.trees.values())
    return [project.actions[name] for name in sorted(project.actions) if name in used]


def unwritten_actions(project: Project) -> list[str]:
    """Returns the names of actions that are stubs and that the main tree may run."""
    from tree_gardener.stubs import is_stub  # noqa: PLC0415 - the engine loads py_trees

    reached = reachable_trees(project.trees, project.settings.main_tree)
    used = used_types(project.trees[tree_id] for tree_id in reached)
    return [
        name for name in sorted(project.actions) if name in used and is_stub(project.actions[name].source)
    ]


def write_self_contained(project: Project) -> str:
    """Returns the document of `self_contained`, for a project without errors."""
    return write_document(project, after=(*enum_lines(project.enums), *_code_lines(project)))


def _code_lines(project: Project) -> Iterator[str]:
    actions = used_actions(project)
    if not actions:
        return
    modules = shared_modules(project, [action.name for action in actions])
    yield "  <Code>"
    for action in actions:
        digest = hashlib.sha256(project.files[action.path]).hexdigest()
        tag = f'<Action name="{attribute(action.name)}" sha256="{digest}">'
        yield f"    {tag}{cdata(source_text(action.source))}</Action>"
    for module in modules:  # they are run where an action imports them
        digest = hashlib.sha256(project.files[module.path]).hexdigest()
        tag = f'<Module name="{attribute(module.name)}" sha256="{digest}">'
        yield f"    {tag}{cdata(source_text(module.source))}</Module>"
    yield "  </Code>"
