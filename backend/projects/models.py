"""Projects as immutable revisions. No other app uses the tables; only `storage.writes` writes them.

A change set is one user action; the change sets of a project are numbered. The revision of a file is the
number of the change set that last changed it. Numbers only grow, so a client that knows revision b of a
project knows every file whose revision is at most b. Contents are stored once, as blobs that are named by
their hash. With the table of current files, a project is opened with one query.
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
    """Content, named by its SHA-256: its bytes, or the name of the object that has them (`stored_at`).

    `unreferenced_at` and `marked_at` are the progress of the collection of objects (`storage.collection`).
    """

    sha256 = models.CharField(max_length=64, primary_key=True)
    size = models.PositiveBigIntegerField()
    data = models.BinaryField(null=True)
    stored_at = models.CharField(max_length=200, null=True)  # noqa: DJ001 - null, as `data` is of others
    unreferenced_at = models.DateTimeField(null=True)
    marked_at = models.DateTimeField(null=True)

    class Meta:
        constraints = [
            models.CheckConstraint(
                condition=Q(data=None, stored_at__isnull=False) | Q(data__isnull=False, stored_at=None),
                name="blob_is_in_one_place",
            )
        ]
        indexes = [
            models.Index(fields=["stored_at"], condition=Q(stored_at__isnull=False), name="blob_stored")
        ]


class Project(models.Model):
    """A project.

    For lists, the row repeats the name, description, main tree and universe of `project.json`.
    """

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

    # These are no columns: `role` is the role of the user who made the request, set by `queries`; `now` holds
    # the files after the write that returned this project.
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
    """The share of a project with one person; the owner has no row."""

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="memberships")
    user = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE, related_name="memberships")
    role = models.PositiveSmallIntegerField(choices=[(role.value, role.label) for role in SHARED_ROLES])
    created_at = models.DateTimeField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "user"], name="membership_unique")]


class GroupShare(models.Model):
    """The share of a project with all members of a group."""

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
    """The result of a change set for one file; without a blob, the file was removed."""

    change = models.ForeignKey(ChangeSet, on_delete=models.CASCADE, related_name="files")
    path = models.CharField(max_length=MAX_PATH_LENGTH)
    blob = models.ForeignKey(Blob, on_delete=models.PROTECT, null=True)
    renamed_from = models.CharField(max_length=MAX_PATH_LENGTH, blank=True)

    class Meta:
        constraints = [models.UniqueConstraint(fields=["change", "path"], name="file_revision_unique")]


class CurrentFile(models.Model):
    """The newest revision of a file.

    `path_key` is equal for paths that some file systems cannot distinguish.
    """

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="files")
    path = models.CharField(max_length=MAX_PATH_LENGTH)
    path_key = models.CharField(max_length=4 * MAX_PATH_LENGTH)
    revision = models.PositiveIntegerField()
    updated_at = models.DateTimeField()
    blob = models.ForeignKey(Blob, on_delete=models.PROTECT)

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "path_key"], name="current_path_unique")]


class Draft(models.Model):
    """Text that a user has typed into a file and not saved; it is never part of a revision."""

    project = models.ForeignKey(Project, on_delete=models.CASCADE, related_name="drafts")
    author = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE)
    path = models.CharField(max_length=MAX_PATH_LENGTH)
    base_revision = models.PositiveIntegerField()
    content = models.TextField(blank=True)
    updated_at = models.DateTimeField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["project", "author", "path"], name="draft_unique")]


class IdempotencyKey(models.Model):
    """The stored answer to a request. A client may repeat the request without repeating its effect."""

    author = models.ForeignKey(settings.AUTH_USER_MODEL, on_delete=models.CASCADE)
    key = models.CharField(max_length=100)
    fingerprint = models.CharField(max_length=64)
    status = models.PositiveSmallIntegerField()
    answer = models.JSONField()
    created_at = models.DateTimeField(db_index=True)

    class Meta:
        constraints = [models.UniqueConstraint(fields=["author", "key"], name="idempotency_key_unique")]
