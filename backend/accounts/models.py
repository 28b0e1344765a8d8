"""Users, groups, invitations and the audit log.

On localhost there is one user without a password, and the other tables are empty.
"""

from __future__ import annotations

import uuid

from django.contrib.auth.models import AbstractUser
from django.db import models

MAX_GROUP_NAME = 80


class User(AbstractUser):
    """A person who owns projects.

    `links` is not a column: it holds the read-only links that this browser opened, with or without an
    account. A guest is a user that is not stored.
    """

    is_teacher = models.BooleanField(
        "teacher", default=False, help_text="May make groups and invite people to this server."
    )
    max_bytes = models.PositiveBigIntegerField(
        "room for projects", null=True, blank=True, help_text="Bytes; empty is the server's limit."
    )
    max_projects = models.PositiveIntegerField(
        "number of projects", null=True, blank=True, help_text="Empty is the server's limit."
    )

    is_exempt = models.BooleanField(
        "demonstration",
        default=False,
        db_default=False,
        help_text="Has no limit of robots, editors and tests at a time, and goes first when all places are "
        "taken. For a demonstration.",
    )

    links: frozenset[uuid.UUID] = frozenset()

    @property
    def is_guest(self) -> bool:
        """Whether the user has a read-only link and no account."""
        return self.pk is None


class Group(models.Model):
    """A group of people with whom projects are shared, such as a class."""

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    name = models.CharField(max_length=MAX_GROUP_NAME)
    owner = models.ForeignKey(User, on_delete=models.CASCADE, related_name="own_groups")
    members = models.ManyToManyField(User, through="GroupMember", related_name="joined_groups")
    created_at = models.DateTimeField()

    def __str__(self) -> str:
        return self.name


class GroupMember(models.Model):
    """The membership of one person in one group."""

    group = models.ForeignKey(Group, on_delete=models.CASCADE, related_name="member_rows")
    user = models.ForeignKey(User, on_delete=models.CASCADE, related_name="member_rows")
    joined_at = models.DateTimeField()

    class Meta:
        constraints = [models.UniqueConstraint(fields=["group", "user"], name="group_member_unique")]


class Invitation(models.Model):
    """A link with which people create an account and join a group. The link is signed, not stored."""

    id = models.UUIDField(primary_key=True, default=uuid.uuid4, editable=False)
    created_by = models.ForeignKey(User, on_delete=models.CASCADE, related_name="invitations")
    group = models.ForeignKey(Group, on_delete=models.CASCADE, null=True, blank=True)
    created_at = models.DateTimeField()
    expires_at = models.DateTimeField()
    max_uses = models.PositiveIntegerField()
    uses = models.PositiveIntegerField(default=0)
    revoked_at = models.DateTimeField(null=True, blank=True)


class AuditEntry(models.Model):
    """One entry of the audit log; changes of files are in the projects' own history."""

    at = models.DateTimeField(db_index=True)
    actor = models.ForeignKey(User, on_delete=models.SET_NULL, null=True, blank=True)
    actor_name = models.CharField(max_length=150, blank=True)
    action = models.CharField(max_length=60, db_index=True)
    subject = models.CharField(max_length=200, blank=True)
    subject_id = models.CharField(max_length=64, blank=True)
    address = models.GenericIPAddressField(null=True, blank=True)
    detail = models.JSONField(default=dict, blank=True)

    class Meta:
        verbose_name_plural = "audit log"
        ordering = ("-at", "-id")
