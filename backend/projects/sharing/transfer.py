"""Changes the owner of a project; the previous one becomes an editor."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db import transaction
from django.utils import timezone

from backend.accounts.audit import note
from backend.accounts.writes import user_named
from backend.core.locks import transaction_lock
from backend.core.problems import InvalidInputError
from backend.projects.choices import Role
from backend.projects.errors import QuotaExceededError
from backend.projects.models import Membership, Project
from backend.projects.sharing import memberships
from backend.projects.storage import names, queries, usage, writes
from backend.projects.storage.access import with_role
from backend.projects.storage.changes import Content, FileChange
from backend.projects.storage.manifest import MANIFEST, read, write

if TYPE_CHECKING:
    from uuid import UUID

    from backend.accounts.models import User


@transaction.atomic
def transfer_project(project_id: UUID, name: str, *, acting_user: User, if_match: str = "") -> Project:
    """Makes an editor of a project its owner.

    The person must be an editor, so that the new owner knows the project.

    The project counts towards the new owner's quota. Its name gets a number if the new owner has a project of
    the same name.

    Raises:
        InvalidInputError: the person is not an editor of the project.
        QuotaExceededError: the new owner's quota does not suffice.
    """
    project = memberships.owned(project_id, acting_user, if_match)
    person = user_named(name)
    if person is not None and person.pk == project.owner_id:
        raise InvalidInputError("The project is yours already.", field="name")
    if person is None or not person.is_active or not _is_editor(project, person):
        raise InvalidInputError(
            f"“{names.shown(name)}” is not an editor of this project.",
            hint="Share the project with them as an editor first.",
            field="name",
        )
    transaction_lock(f"projects of {person.pk}")
    taken = set(Project.objects.filter(owner=person, deleted_at=None).values_list("name_key", flat=True))
    _require_room(project, person)
    Membership.objects.filter(project=project, user=person).delete()
    Membership.objects.create(project=project, user=acting_user, role=Role.EDITOR, created_at=timezone.now())
    old_name, project.owner = project.name, person
    project.name = names.free_name(old_name, taken)
    project.name_key = names.key(project.name)
    project.save(update_fields=["owner", "name", "name_key"])
    if project.name != old_name:
        _rename(project, acting_user)
    project.role = Role.EDITOR
    note(
        "project.transfer", actor=acting_user, subject=project.name, subject_id=project.id, to=person.username
    )
    return project


def _is_editor(project: Project, person: User) -> bool:
    found = with_role(Project.objects.filter(pk=project.pk), person).first()
    return Role(getattr(found, "rank", Role.NONE)) >= Role.EDITOR


def _require_room(project: Project, person: User) -> None:
    room = usage.usage(person)
    if room["projects"] >= room["max_projects"] or room["bytes"] + project.size > room["max_bytes"]:
        raise QuotaExceededError(
            f"{person.username} has no room for this project.",
            hint="Ask them to delete what they no longer need, or an administrator for more room.",
        )


def _rename(project: Project, acting_user: User) -> None:
    raw = queries.current_files(project, [MANIFEST])[MANIFEST]
    document = dict(read(raw.data).document) | {"name": project.name}
    change = FileChange(MANIFEST, raw.revision, Content.of(write(document)))
    message = "Change the owner, who has another project of this name"
    writes.save_files(project.id, [change], acting_user=acting_user, message=message)
