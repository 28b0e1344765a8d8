"""Projects as immutable revisions. Nothing outside this app touches the tables; only `storage.writes` writes.

A change set is one user action. It is number n of its project, and a file's revision is the number of
the change set that last touched it; so numbers only grow, and a client that knows revision b of a
project has seen a file when the file's revision is at most b. Contents are blobs named by their hash,
stored once. The table of current files answers "open this project" in one query.
"""

from __future__ import annotations

import uuid
from typing import TYPE_CHECKING

from django.conf import settings
from django.db import models
from django.db.models import Q

from backend.accounts.models import Group
from backend.projects.choices import SHARED_ROLES, Role
from backend.projects.storage.names import MAX_NAME_LENGTH, MAX_PATH_LENGTH

if TYPE_CHECKING:
    from collections.abc import Mapping

    from backend.projects.storage.changes import Existing


class Blob(models.Model):
    """Content, named by its SHA-256."""

    sha256 = models.CharField(max_length=64, primary_key=True)
    size = models.PositiveBigIntegerField()
    data = models.BinaryField()


class Project(models.Model):
    """A project; name, description, main tree and universe repeat its `project.json` for lists."""

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    owner = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE, related_name="projects")
    name = models.CharField(max_length=MAX_NAME_LENGTH)
    name_key = models.CharField(max_length=4 * MAX_NAME_LENGTH)
    description = models.TextField(blank=True)
    main_tree = models.CharField(max_length=MAX_NAME_LENGTH)
    universe = models.CharField(max_length=MAX_NAME_LENGTH, blank=True)
    revision = models.PositiveIntegerField(default=0)
    size = models.PositiveBigIntegerField(default=0)
    created_at = models.DateTimeField()
    updated_at = models.DateTimeField(db_index=True)
    archived_at = models.DateTimeField(null=True, blank=True)
    deleted_at = models.DateTimeField(null=True, blank=True)

    # No columns: what the user who asked may do with it, as `queries` found out; and its files,
    # as the write left them that this row comes from.
    role: Role = Role.OWNER
    now: Mapping[str, Existing] | None = None

    class Meta:
        constraints = [
            models.UniqueConstraint(
                fields=["owner", "name_key"], condition=Q(deleted_at=None), name="project_name_unique"
            )
        ]

    def __str__(self) -> str:
        return self.name


class Membership(models.Model):
    """A project shared with one person; the owner has no row."""

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="memberships")
    user = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE, related_name="memberships")
    role = models.PositiveSmallIntegerField(choices=[(role.value, role.label) for role in SHARED_ROLES])
    created_at = models.DateTimeField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "user"], name="membership_unique")]


class GroupShare(models.Model):
    """A project shared with everybody in a group."""

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="group_shares")
    group = models.ForeignKey(Group, on_delete=models.CASCADE, related_name="shares")
    role = models.PositiveSmallIntegerField(choices=[(role.value, role.label) for role in SHARED_ROLES])
    created_at = models.DateTimeField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "group"], name="group_share_unique")]


class ShareLink(models.Model):
    """A link with which anyone can read a project. The link is signed, not stored."""

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="links")
    created_by = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.SET_NULL, null=True)
    created_at = models.DateTimeField()
    expires_at = models.DateTimeField(null=True, blank=True)
    revoked_at = models.DateTimeField(null=True, blank=True)


class ChangeSet(models.Model):
    """One user action on the files of a project."""

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="changes")
    number = models.PositiveIntegerField()
    author = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.SET_NULL, null=True)
    message = models.CharField(max_length=500, blank=True)
    label = models.CharField(max_length=100, blank=True)
    created_at = models.DateTimeField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "number"], name="change_number_unique")]


class FileRevision(models.Model):
    """The result of a change set for one file; no blob means that it removed the file."""

    change = models.ForeignKey(ChangeSet, on_delete=models.CASCADE, related_name="files")
    path = models.CharField(max_length=MAX_PATH_LENGTH)
    blob = models.ForeignKey(Blob, on_delete=models.PROTECT, null=True)
    renamed_from = models.CharField(max_length=MAX_PATH_LENGTH, blank=True)

    class Meta:
        constraints = [models.UniqueConstraint(fields=["change", "path"], name="file_revision_unique")]


class CurrentFile(models.Model):
    """The newest revision of a file; `path_key` is equal for paths that some disk would confuse."""

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="files")
    path = models.CharField(max_length=MAX_PATH_LENGTH)
    path_key = models.CharField(max_length=4 * MAX_PATH_LENGTH)
    revision = models.PositiveIntegerField()
    updated_at = models.DateTimeField()
    blob = models.ForeignKey(Blob, on_delete=models.PROTECT)

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "path_key"], name="current_path_unique")]


class Draft(models.Model):
    """Text that one user typed into one file and did not save; never part of a revision."""

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="drafts")
    author = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE)
    path = models.CharField(max_length=MAX_PATH_LENGTH)
    base_revision = models.PositiveIntegerField()
    content = models.TextField(blank=True)
    updated_at = models.DateTimeField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "author", "path"], name="draft_unique")]


class IdempotencyKey(models.Model):
    """The answer to a request that a client may repeat without repeating its effect."""

    author = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE)
    key = models.CharField(max_length=100)
    fingerprint = models.CharField(max_length=64)
    status = models.PositiveSmallIntegerField()
    answer = models.JSONField()
    created_at = models.DateTimeField(db_index=True)

    class Meta:
        constraints = [models.UniqueConstraint(fields=["author", "key"], name="idempotency_key_unique")]
