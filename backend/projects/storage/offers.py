"""The trees that projects offer to other projects in their library, each with the files that it uses."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from django.db.models import BinaryField, BooleanField, Exists, F, Func, OuterRef, Q, Value

from backend.projects.models import CurrentFile
from backend.projects.storage import cache, queries

if TYPE_CHECKING:
    from collections.abc import Mapping
    from uuid import UUID

    from django.db.models import QuerySet

    from backend.accounts.models import User
    from backend.projects.models import Project

OFFERED: Final = "_bts_offered"
"""The attribute of a tree that offers it; its value is "1"."""
_TREE: Final = re.compile(r"trees/([^/]+)\.json")
_ACTION: Final = re.compile(r"actions/([^/]+)\.py")
_WORD: Final = re.compile(r"\w+")


class _Holds(Func):
    """Whether the first bytes contain the second ones; the database searches, so contents are not fetched."""

    output_field = BooleanField()
    arity = 2
    arg_joiner = ", "
    template = "(instr(%(expressions)s) > 0)"

    def as_postgresql(self, compiler: Any, connection: Any, **context: Any) -> Any:
        """Returns the call in PostgreSQL's form for bytes."""
        template = '(pg_catalog."position"(%(expressions)s) > 0)'
        return self.as_sql(compiler, connection, template=template, **context)


@dataclass(frozen=True, slots=True)
class Offer:
    """The trees that a project offers, and the texts of all files that they may use."""

    project: Project
    trees: list[str]
    files: dict[str, str]


def offering(user: User) -> QuerySet[Project]:
    """Returns the user's own and shared projects that may offer a tree, the newest first."""
    trees = CurrentFile.objects.filter(project=OuterRef("pk"), path__startswith="trees/")
    holds = _Holds(F("blob__data"), Value(OFFERED.encode(), output_field=BinaryField()))
    # The database cannot search a tree that is in the object store.
    marked = trees.filter(Q(holds) | Q(blob__stored_at__isnull=False))
    return queries.projects(user=user).filter(Exists(marked))


def offers(user: User, start: int, end: int) -> tuple[list[Offer], int]:
    """Returns the offers of these projects, and the number of all projects that may have one."""
    found, total = queries.page(offering(user), start, end, user=user)
    files = _files(found)
    rows = (_offer(project, files.get(project.id, {})) for project in found)
    return [row for row in rows if row.trees], total


def _files(projects: list[Project]) -> dict[UUID, dict[str, str]]:
    """Returns the texts of the trees and actions of these projects."""
    kinds = Q(path__startswith="trees/") | Q(path__startswith="actions/")
    rows = CurrentFile.objects.filter(kinds, project__in=projects).order_by("path")
    fields = list(rows.values_list("project_id", "path", "blob_id"))
    data = cache.contents(blob for _, _, blob in fields)
    files: dict[UUID, dict[str, str]] = {}
    for project, path, blob in fields:
        text = queries.as_text(data[blob])
        if text is not None:
            files.setdefault(project, {})[path] = text
    return files


def _offer(project: Project, files: Mapping[str, str]) -> Offer:
    trees = {
        match[1]: _nodes_and_offer(text) for path, text in files.items() if (match := _TREE.fullmatch(path))
    }
    offered = [name for name, (_, is_offered) in trees.items() if is_offered]
    uses = {name: used for name, (used, _) in trees.items()}
    paths = _used(offered, uses, files)
    return Offer(project, offered, {path: files[path] for path in sorted(paths)})


def _used(offered: list[str], uses: Mapping[str, set[str]], files: Mapping[str, str]) -> set[str]:
    """Returns the files of these trees, and all that they use.

    An action uses each other action that its text names. The result may contain a file too many, but never
    lacks one.
    """
    actions = {match[1]: path for path in files if (match := _ACTION.fullmatch(path))}
    found: set[str] = set()
    waiting = [f"trees/{name}.json" for name in offered]
    while waiting:
        path = waiting.pop()
        if path in found or path not in files:
            continue
        found.add(path)
        if match := _TREE.fullmatch(path):
            waiting += uses[match[1]]
        else:
            waiting += (actions[word] for word in set(_WORD.findall(files[path])) if word in actions)
    return found


def _nodes_and_offer(text: str) -> tuple[set[str], bool]:
    """Returns the files that a tree's blocks name, and whether the tree is offered."""
    try:
        diagram = json.loads(text)
    except (ValueError, RecursionError):
        return set(), False
    if not isinstance(diagram, dict):
        return set(), False
    nodes, attributes = diagram.get("nodes"), diagram.get("attributes")
    found = nodes.values() if isinstance(nodes, dict) else ()
    blocks = [node for node in found if isinstance(node, dict)]
    paths = {
        f"trees/{node.get('tree')}.json"
        if node.get("type") == "SubTree"
        else f"actions/{node.get('type')}.py"
        for node in blocks
    }
    return paths, isinstance(attributes, dict) and attributes.get(OFFERED) == "1"
