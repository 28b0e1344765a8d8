"""The trees that projects offer to other projects in their library, each with the files that it uses."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from django.db.models import BinaryField, BooleanField, Case, Count, Exists, F, Func, OuterRef, Q, Value, When

from backend.core.readers import reserve
from backend.projects.models import CurrentFile
from backend.projects.storage import cache, queries
from backend.workers.offered import OFFERED, uses

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from uuid import UUID

    from django.db.models import QuerySet

    from backend.accounts.models import User
    from backend.projects.models import Project

LARGEST: Final = 256 * 1024
"""Bytes of all files of one project's offers; a project whose offered trees use more is not in the list."""
MOST_FILES: Final = 1000
"""The largest number of trees and actions of a project in the list."""
_TREE: Final = re.compile(r"trees/([^/]+)\.json")
_KINDS: Final = Q(path__startswith="trees/") | Q(path__startswith="actions/")


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


_MARKED: Final = Q(blob__size__lte=LARGEST, path__startswith="trees/") & (
    Q(_Holds(F("blob__data"), Value(OFFERED.encode(), output_field=BinaryField())))
    # The database cannot search a tree that is in the object store.
    | Q(blob__stored_at__isnull=False)
)


def offering(user: User) -> QuerySet[Project]:
    """Returns the user's own and shared projects that may offer a tree, the newest first."""
    return queries.projects(user=user).filter(
        Exists(CurrentFile.objects.filter(_MARKED, project=OuterRef("pk")))
    )


class Collecting:
    """Finds the offers of a page of projects in rounds: what one round reads names the files of the next.

    `texts` are the files of a round; they are read by `uses`, in the pool, whose answer is given to `add`. If
    there are none, `offers` are complete. Of each project at most `LARGEST` bytes are read.
    """

    def __init__(self, user: User, start: int, end: int) -> None:
        found, self.total = queries.page(offering(user), start, end, user=user)
        reserve(LARGEST * len(found))
        self.texts: dict[str, dict[str, str]] = {}
        files = _listed(found) if found else {}
        self._projects = [_Reading(project, files[project.id]) for project in found if project.id in files]
        self._fetch()

    @property
    def offers(self) -> list[Offer]:
        """The offers, in the order of the projects."""
        return [reading.offer() for reading in self._projects if reading.offered]

    def add(self, found: Mapping[str, Any]) -> None:
        """Takes what the texts of this round name, and fetches the files that are needed next."""
        for number, reading in enumerate(self._projects):
            for path in reading.wanted:
                key = f"{number}/{path}"
                if key in found["used"]:
                    reading.add(path, found["used"][key], is_offered=key in found["offered"])
            reading.advance()
        self._fetch()

    def _fetch(self) -> None:
        data = cache.contents(
            reading.files[path].sha256 for reading in self._projects for path in reading.wanted
        )
        self.texts = {"trees": {}, "actions": {}}
        for number, reading in enumerate(self._projects):
            for path in reading.wanted:
                text = queries.as_text(data[reading.files[path].sha256])
                if text is not None:
                    reading.texts[path] = text
                    kind = "trees" if _TREE.fullmatch(path) else "actions"
                    self.texts[kind][f"{number}/{path}"] = text
        if not any(self.texts.values()):
            self.texts = {}


class _File(NamedTuple):
    sha256: str
    size: int
    is_marked: bool
    """Whether it may be a tree that is offered."""


class _Reading:
    """The files of one project that are read for its offers.

    Attributes:
        wanted: the files of this round.
        texts: those that were read.
        offered: the trees that are offered; none if they use too much.
    """

    def __init__(self, project: Project, files: Mapping[str, _File]) -> None:
        self._project, self.files = project, files
        self._uses: dict[str, set[str]] = {}
        self._left = LARGEST
        self._asked: set[str] = set()
        self.texts: dict[str, str] = {}
        self.offered: list[str] = []
        self.wanted: list[str] = []
        self._want([path for path, file in files.items() if file.is_marked and _TREE.fullmatch(path)])

    def offer(self) -> Offer:
        """Returns the offered trees with all files that they use."""
        paths = sorted(path for path in self._reached() if path in self.texts)
        return Offer(self._project, self.offered, {path: self.texts[path] for path in paths})

    def add(self, path: str, used: Iterable[str], *, is_offered: bool) -> None:
        """Takes what a file names; an action uses each other action that its text names."""
        tree = _TREE.fullmatch(path)
        paths = set(used) if tree else {f"actions/{word}.py" for word in used}
        self._uses[path] = paths & self.files.keys()
        if tree and is_offered:
            self.offered.append(tree[1])

    def advance(self) -> None:
        """Chooses the files of the next round: what is used and was not read."""
        self._want(sorted(self._reached() - self._asked))

    def _want(self, paths: list[str]) -> None:
        self._asked.update(paths)
        self._left -= sum(self.files[path].size for path in paths)
        self.wanted = paths
        if self._left < 0:
            self.wanted, self.offered = [], []

    def _reached(self) -> set[str]:
        found: set[str] = set()
        waiting = [f"trees/{name}.json" for name in self.offered]
        while waiting:
            path = waiting.pop()
            if path not in found:
                found.add(path)
                waiting += self._uses.get(path, ())
        return found


def offers(user: User, start: int, end: int) -> tuple[list[Offer], int]:
    """Returns the offers of these projects, and the number of all projects that may have one."""
    collecting = Collecting(user, start, end)
    while collecting.texts:
        collecting.add(uses(**collecting.texts))
    return collecting.offers, collecting.total


def _listed(projects: list[Project]) -> dict[UUID, dict[str, _File]]:
    """Returns the trees and actions of each of these projects that has not too many."""
    rows = CurrentFile.objects.filter(_KINDS, project__in=projects)
    counts = rows.values_list("project").annotate(number=Count("id"))
    files: dict[UUID, dict[str, _File]] = {project: {} for project, number in counts if number <= MOST_FILES}
    listed = rows.filter(project__in=list(files)).annotate(
        marked=Case(When(_MARKED, then=True), default=False)
    )
    columns = ("project", "path", "blob", "blob__size", "marked")
    for project, path, *fields in listed.order_by("path").values_list(*columns):
        files[project][path] = _File(*fields)
    return files
