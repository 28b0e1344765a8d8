"""From a project to XML: plain, and with the actions inside."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

from translator.action import ActionModel, source_text
from translator.check import check
from translator.diagnostic import TranslatorError, errors_in
from translator.tree import used_types
from translator.xml.escape import attribute, cdata
from translator.xml.write import write_document

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.project import Project


def to_xml(project: Project) -> str:
    """Returns the project's trees as one BehaviorTree.CPP v4 document.

    Raises:
        TranslatorError: If the project has errors; its `diagnostics` name them.
    """
    require_sound(project)
    return write_document(project)


def self_contained(project: Project) -> str:
    """Returns the document with the source of each action used, so that one file is enough to run it.

    Raises:
        TranslatorError: If the project has errors; its `diagnostics` name them.
    """
    require_sound(project)
    return write_self_contained(project)


def require_sound(project: Project) -> None:
    """Raises `TranslatorError` if the checks find an error."""
    errors = errors_in(check(project))
    if errors:
        raise TranslatorError(errors)


def used_actions(project: Project) -> list[ActionModel]:
    """Returns the actions that some tree uses, by name."""
    used = used_types(project.trees.values())
    return [project.actions[name] for name in sorted(project.actions) if name in used]


def write_self_contained(project: Project) -> str:
    """Like `self_contained`, for a project that is known to be sound."""
    return write_document(project, after=_code_lines(project))


def _code_lines(project: Project) -> Iterator[str]:
    actions = used_actions(project)
    if not actions:
        return
    yield "  <Code>"
    for action in actions:
        digest = hashlib.sha256(project.files[action.path]).hexdigest()
        tag = f'<Action name="{attribute(action.name)}" sha256="{digest}">'
        yield f"    {tag}{cdata(source_text(action))}</Action>"
    yield "  </Code>"
