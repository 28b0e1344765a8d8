"""Writes to groups, such as classes, and reads of their members."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from django.db import transaction
from django.db.models import Q
from django.utils import timezone

from backend.accounts import invitations, links
from backend.accounts.audit import note
from backend.accounts.models import Group, GroupMember, Invitation, User
from backend.accounts.permissions import TeacherRequiredError
from backend.core.problems import NotFoundError

if TYPE_CHECKING:
    from uuid import UUID

    from django.db.models import QuerySet


def groups_of(user: User) -> QuerySet[Group]:
    """Returns the groups that the user made, and those of which the user is a member."""
    mine = Q(owner=user) | Q(pk__in=GroupMember.objects.filter(user=user).values("group"))
    return Group.objects.filter(mine).select_related("owner").order_by("name", "id")


def group(group_id: UUID, *, user: User, own: bool = False) -> Group:
    """Returns a group of the user. With `own`, the user must have made it, or be an administrator.

    Raises:
        NotFoundError: the group does not exist, or the user neither made it nor is a member.
        TeacherRequiredError: the user is a member, but did not make the group.
    """
    rows = Group.objects.select_related("owner") if user.is_superuser else groups_of(user)
    found = rows.filter(pk=group_id).first()
    if found is None:
        raise NotFoundError("There is no such group.")
    if own and found.owner_id != user.pk and not user.is_superuser:
        raise TeacherRequiredError(f"“{found.name}” is managed by {found.owner.username}.")
    return found


@transaction.atomic
def create(name: str, *, acting_user: User) -> Group:
    """Makes an empty group.

    Raises:
        TeacherRequiredError: the user may not make groups.
    """
    if not invitations.may_invite(acting_user):
        raise TeacherRequiredError("Groups are for teachers and administrators.")
    made = Group.objects.create(name=name, owner=acting_user, created_at=timezone.now())
    note("group.create", actor=acting_user, subject=name, subject_id=made.id)
    return made


@transaction.atomic
def rename(group_id: UUID, name: str, *, acting_user: User) -> Group:
    """Renames a group."""
    found = group(group_id, user=acting_user, own=True)
    found.name = name
    found.save(update_fields=["name"])
    return found


@transaction.atomic
def delete(group_id: UUID, *, acting_user: User) -> None:
    """Removes a group: its shares and invitations end; accounts stay."""
    found = group(group_id, user=acting_user, own=True)
    note("group.delete", actor=acting_user, subject=found.name, subject_id=found.id)
    found.delete()


@transaction.atomic
def remove_member(group_id: UUID, name: str, *, acting_user: User) -> None:
    """Removes a member from the group. Every member may leave it.

    Raises:
        NotFoundError: the group has no member of this name.
    """
    leaving = name == acting_user.username
    found = group(group_id, user=acting_user, own=not leaving)
    gone, _ = GroupMember.objects.filter(group=found, user__username=name).delete()
    if not gone:
        raise NotFoundError("The group has no member of this name.")
    note("group.remove_member", actor=acting_user, subject=found.name, subject_id=found.id, member=name)


def presented(found: Group, *, user: User) -> dict[str, Any]:
    """Returns a group as the API shows it; members and invitations only to its managers."""
    mine = found.owner_id == user.pk or user.is_superuser
    members = GroupMember.objects.filter(group=found).select_related("user").order_by("user__username")
    open_ones = [row for row in Invitation.objects.filter(group=found) if mine and invitations.usable(row.id)]
    return {
        "id": str(found.id),
        "name": found.name,
        "owner": found.owner.username,
        "mine": mine,
        "members": [person(row.user) for row in members] if mine else [],
        "invitations": [presented_invitation(row) for row in open_ones],
    }


def person(user: User) -> dict[str, str]:
    """Returns a person as other users see them."""
    return {"username": user.username, "name": user.get_full_name()}


def presented_invitation(row: Invitation) -> dict[str, Any]:
    """Returns an invitation with its link."""
    return {
        "id": str(row.id),
        "url": links.link_of("join", row.id),
        "expires_at": row.expires_at.isoformat(),
        "uses": row.uses,
        "max_uses": row.max_uses,
    }
