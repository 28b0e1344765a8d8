"""Writes to the members of a project; only the owner may make them."""

from __future__ import annotations

import hashlib
import json
from datetime import timedelta
from typing import TYPE_CHECKING, Any

from django.db import transaction
from django.utils import timezone

from backend.accounts import groups, links
from backend.accounts.audit import note
from backend.accounts.rights import lessen
from backend.accounts.writes import user_named
from backend.core.problems import InvalidInputError, NotFoundError
from backend.projects.choices import Role
from backend.projects.errors import matches
from backend.projects.models import GroupShare, Membership, Project, ShareLink
from backend.projects.storage import queries
from backend.projects.storage.access import Need, open_links

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User

CHANGED = "Someone changed meanwhile with whom this project is shared."


def shares(project: Project) -> dict[str, Any]:
    """Returns the people, groups and links with which a project is shared."""
    people = Membership.objects.filter(project=project).select_related("user").order_by("user__username")
    classes = GroupShare.objects.filter(project=project).select_related("group").order_by("group__name")
    ids = ShareLink.objects.filter(project=project, revoked_at=None).values_list("id", flat=True)
    return {
        "owner": groups.person(project.owner),
        "people": [groups.person(row.user) | {"role": Role(row.role).label} for row in people],
        "groups": [
            {"id": str(row.group_id), "name": row.group.name, "role": Role(row.role).label} for row in classes
        ],
        "links": [_link(row) for row in open_links(ids).order_by("created_at")],
    }


def _link(row: ShareLink) -> dict[str, Any]:
    return {
        "id": str(row.id),
        "url": links.link_of("shared", row.id),
        "expires_at": row.expires_at and row.expires_at.isoformat(),
        "created_at": row.created_at.isoformat(),
    }


def etag(document: dict[str, Any]) -> str:
    """Returns an ETag that changes with everything that `shares` returns."""
    return f'"{hashlib.sha256(json.dumps(document, sort_keys=True).encode()).hexdigest()[:32]}"'


def owned(project_id: UUID, user: User, if_match: str) -> Project:
    """Returns the project and locks it, if the user is its owner. `if_match` is the ETag of `shares`."""
    project = queries.project(project_id, user=user, need=Need.MANAGE, lock=True)
    if if_match:
        matches(if_match, etag(shares(project)), CHANGED)
    return project


@transaction.atomic
def share_with_person(
    project_id: UUID, name: str, role: Role, *, acting_user: User, if_match: str = ""
) -> Project:
    """Gives a person a role, by their name or e-mail address.

    Raises:
        NotFoundError: there is no such account.
        InvalidInputError: the account is that of the owner.
    """
    project = owned(project_id, acting_user, if_match)
    person = user_named(name)
    if person is None or not person.is_active:
        raise NotFoundError(f"There is no account “{name}”.", field="name")
    if person.pk == project.owner_id:
        raise InvalidInputError("The project is yours already.", field="name")
    now = timezone.now()
    Membership.objects.update_or_create(
        project=project,
        user=person,
        defaults={"role": role},
        create_defaults={"role": role, "created_at": now},
    )
    _note("share", project, acting_user, person=person.username, role=role.label)
    return project


@transaction.atomic
def unshare_with_person(project_id: UUID, name: str, *, acting_user: User, if_match: str = "") -> Project:
    """Removes the role of a person. Users can remove their own role.

    Raises:
        NotFoundError: the project is not shared with the person.
    """
    if name == acting_user.username:
        project = queries.project(project_id, user=acting_user, need=Need.COPY, lock=True)
    else:
        project = owned(project_id, acting_user, if_match)
    if not Membership.objects.filter(project=project, user__username=name).delete()[0]:
        raise NotFoundError("The project is not shared with this person.")
    _note("unshare", project, acting_user, person=name)
    return project


@transaction.atomic
def share_with_group(
    project_id: UUID, group_id: UUID, role: Role, *, acting_user: User, if_match: str = ""
) -> Project:
    """Gives a role to all members of a group that the user manages or is in."""
    project = owned(project_id, acting_user, if_match)
    found = groups.group(group_id, user=acting_user)
    GroupShare.objects.update_or_create(
        project=project,
        group=found,
        defaults={"role": role},
        create_defaults={"role": role, "created_at": timezone.now()},
    )
    _note("share", project, acting_user, group=found.name, role=role.label)
    return project


@transaction.atomic
def unshare_with_group(project_id: UUID, group_id: UUID, *, acting_user: User, if_match: str = "") -> Project:
    """Removes the role of a group."""
    project = owned(project_id, acting_user, if_match)
    if not GroupShare.objects.filter(project=project, group=group_id).delete()[0]:
        raise NotFoundError("The project is not shared with this group.")
    _note("unshare", project, acting_user, group=str(group_id))
    return project


@transaction.atomic
def make_link(project_id: UUID, *, acting_user: User, days: int | None, if_match: str = "") -> Project:
    """Makes a link with which anyone can read the project.

    It is valid for some days, or without limit if `days` is None.
    """
    project = owned(project_id, acting_user, if_match)
    now = timezone.now()
    made = ShareLink.objects.create(
        project=project,
        created_by=acting_user,
        created_at=now,
        expires_at=now + timedelta(days=days) if days else None,
    )
    _note("link", project, acting_user, link=str(made.id), days=days)
    return project


@transaction.atomic
def revoke_link(project_id: UUID, link_id: UUID, *, acting_user: User, if_match: str = "") -> Project:
    """Revokes a link, also for those who have opened it."""
    project = owned(project_id, acting_user, if_match)
    gone = ShareLink.objects.filter(project=project, id=link_id, revoked_at=None).update(
        revoked_at=timezone.now()
    )
    if not gone:
        raise NotFoundError("There is no such link.")
    lessen(project_id=project.id)
    _note("unlink", project, acting_user, link=str(link_id))
    return project


def _note(verb: str, project: Project, actor: User, **detail: Any) -> None:
    note(f"project.{verb}", actor=actor, subject=project.name, subject_id=project.id, **detail)
