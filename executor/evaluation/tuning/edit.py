"""The best values as an edit of the trees of a project."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.evaluation.tuning.space import apply
from translator.diagram import diagram_path, diagram_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.evaluation.tuning.space import Port, Value
    from translator import Project


def edited_trees(project: Project, values: Mapping[Port, Value]) -> dict[str, bytes]:
    """Returns the files of the trees that change, by path."""
    edited = apply(project, values)
    changed = {port.tree for port in values}
    return {diagram_path(name): diagram_text(edited.trees[name]).encode() for name in sorted(changed)}
