"""Decides who may access a project, for every endpoint and socket.

A `Project` is returned only through `gate`, and the caller names the purpose. A user has the highest of these
roles: owner; the role with which the project is shared with the user or with one of the user's groups;
viewer, if the user opened a read-only link.

| need | role | for example |
| --- | --- | --- |
| `READ` | viewer | open, history, diff, check, XML, package, export |
| `COPY`, `RUN` | viewer with an account | duplicate as an own project, run in an own session |
| `WRITE` | editor | save, rename, settings, drafts, restore a revision, label |
| `MANAGE` | owner | archive, delete, restore, share |

A user without a role gets 404, as if the project did not exist; a user whose role is too low gets 403
`role_too_low`.
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Final

from django.db.models import Case, Exists, IntegerField, Max, OuterRef, Q, Subquery, Value, When
from django.db.models.functions import Coalesce, Greatest
from django.utils import timezone

from backend.core.problems import NotFoundError, StudioError
from backend.projects.choices import Role
from backend.projects.models import GroupShare, Membership, Project, ShareLink

if TYPE_CHECKING:
    from collections.abc import Iterable
    from uuid import UUID

    from django.db.models import QuerySet

    from backend.accounts.models import User

NOT_FOUND: Final = "There is no such project."


class Need(Enum):
    """The purpose of an access. It determines the lowest role, and whether an account is required."""

    READ = (Role.VIEWER, False)
    COPY = (Role.VIEWER, True)
    RUN = (Role.VIEWER, True)  # noqa: PIE796 - another reason for the same right
    WRITE = (Role.EDITOR, True)
    MANAGE = (Role.OWNER, True)

    @property
    def role(self) -> Role:
        """The lowest role that suffices."""
        return self.value[0]

    @property
    def account(self) -> bool:
        """Whether guests are refused."""
        return self.value[1]


class RoleTooLowError(StudioError):
    """The user may see the project, but their role does not permit the operation."""

    status = 403
    code = "role_too_low"
    title = "Not allowed"


def gate(project: Project | None, *, user: User, need: Need) -> Project:
    """Returns the project if the user's role suffices; `with_role` or `find_role` must have set the role.

    Raises:
        NotFoundError: the project does not exist, or the user may not know of it.
        RoleTooLowError: the user may see the project, but the role does not suffice.
    """
    role = Role(getattr(project, "rank", Role.NONE)) if project is not None else Role.NONE
    if project is None or role == Role.NONE:
        raise NotFoundError(NOT_FOUND)
    if role < need.role:
        raise RoleTooLowError(
            f"You are {_article(role)} of “{project.name}”; this requires {_article(need.role)}.",
            hint="Ask the owner to share the project with more rights, or work on a copy of your own.",
            role=role.label,
        )
    if need.account and user.is_guest:
        raise RoleTooLowError(
            "You are reading this project by a link; this requires an account.",
            hint="Sign in, then open the link again.",
            role=role.label,
        )
    project.role = role
    return project


def _article(role: Role) -> str:
    return {Role.VIEWER: "a viewer", Role.EDITOR: "an editor", Role.OWNER: "the owner"}[role]


def find_role(project: Project, user: User) -> None:
    """Sets the user's role on a project as `with_role` does. A user's own project needs no query."""
    if project.owner_id == user.pk:
        project.owner, project.rank = user, Role.OWNER.value  # type: ignore[attr-defined]
        return
    rows = with_role(Project.objects.filter(pk=project.pk), user).select_related("owner")
    found = rows.first()
    if found is not None:
        project.owner, project.rank = found.owner, found.rank  # type: ignore[attr-defined]


def find_roles(projects: Iterable[Project], user: User) -> None:
    """Sets the user's role on the projects, with one query for those of other owners.

    Building the SQL of `with_role` takes longer than the rest of a list, and most lists hold only the user's
    own projects.
    """
    others = {}
    for project in projects:
        if project.owner_id == user.pk:
            project.rank = Role.OWNER.value  # type: ignore[attr-defined]
        else:
            # The project may have been deleted, or its share revoked, since it was listed.
            project.rank = Role.NONE.value  # type: ignore[attr-defined]
            others[project.pk] = project
    if not others:
        return
    for found in with_role(Project.objects.filter(pk__in=others), user):
        others[found.pk].rank = found.rank  # type: ignore[attr-defined]


def with_role(rows: QuerySet[Project], user: User) -> QuerySet[Project]:
    """Returns the same projects, each with the user's role as `rank`, in one query."""
    if user.is_guest:
        return rows.annotate(rank=_linked(user))
    direct = Membership.objects.filter(project=OuterRef("pk"), user=user).values("role")
    in_groups = (
        GroupShare.objects.filter(project=OuterRef("pk"), group__member_rows__user=user)
        .values("project")
        .annotate(highest=Max("role"))
        .values("highest")
    )
    shared = Greatest(Coalesce(Subquery(direct), 0), Coalesce(Subquery(in_groups), 0), _linked(user))
    return rows.annotate(
        rank=Case(
            When(owner=user, then=Value(Role.OWNER.value)),
            default=shared,
            output_field=IntegerField(),
        )
    )


def _linked(user: User) -> Case | Value:
    if not user.links:
        return Value(Role.NONE.value)
    return Case(
        When(Exists(open_links(user.links).filter(project=OuterRef("pk"))), then=Value(Role.VIEWER.value)),
        default=Value(Role.NONE.value),
        output_field=IntegerField(),
    )


def open_links(ids: Iterable[UUID]) -> QuerySet[ShareLink]:
    """Returns the links with these ids that are still valid."""
    return ShareLink.objects.filter(
        Q(expires_at=None) | Q(expires_at__gt=timezone.now()),
        id__in=ids,
        revoked_at=None,
        project__deleted_at=None,
        project__owner__is_active=True,
    )


def visible(rows: QuerySet[Project], user: User) -> QuerySet[Project]:
    """Returns the user's own projects and those shared with the user, without those of read-only links."""
    mine = Q(owner=user)
    shared = Q(pk__in=Membership.objects.filter(user=user).values("project")) | Q(
        pk__in=GroupShare.objects.filter(group__member_rows__user=user).values("project")
    )
    return rows.filter(mine | shared)
