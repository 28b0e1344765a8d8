"""Requests and answers of accounts."""

from __future__ import annotations

from typing import Any

from rest_framework import serializers

from backend.accounts.models import MAX_GROUP_NAME


class MeSerializer(serializers.Serializer[Any]):
    """The user and the server's version."""

    mode = serializers.ChoiceField(choices=["local", "team"])
    user = serializers.CharField(help_text="Empty for a guest, who opened a read-only link.")
    name = serializers.CharField()
    email = serializers.CharField()
    role = serializers.ChoiceField(choices=["local", "administrator", "teacher", "user", "guest"])
    version = serializers.CharField()
    users_run_as_server = serializers.BooleanField(
        help_text="Whether the Python of every user can read and change all projects of this server."
    )


class NamedSerializer(serializers.Serializer[Any]):
    """A name for a group."""

    name = serializers.CharField(max_length=MAX_GROUP_NAME)


class DeleteMeSerializer(serializers.Serializer[Any]):
    """The name of the user, typed again as a confirmation."""

    username = serializers.CharField(max_length=150)


class InviteSerializer(serializers.Serializer[Any]):
    """The lifetime of an invitation, and the number of accounts that may be made with it."""

    days = serializers.IntegerField(min_value=1, max_value=365, default=14)
    max_uses = serializers.IntegerField(min_value=1, max_value=10_000, default=30)


class PersonSerializer(serializers.Serializer[Any]):
    """A person as other users see them."""

    username = serializers.CharField()
    name = serializers.CharField()


class InvitationSerializer(serializers.Serializer[Any]):
    """An invitation with its link."""

    id = serializers.UUIDField()
    url = serializers.CharField()
    expires_at = serializers.DateTimeField()
    uses = serializers.IntegerField()
    max_uses = serializers.IntegerField()


class GroupSerializer(serializers.Serializer[Any]):
    """A group; its members and invitations are shown to its managers only."""

    id = serializers.UUIDField()
    name = serializers.CharField()
    owner = serializers.CharField()
    mine = serializers.BooleanField()
    members = PersonSerializer(many=True)
    invitations = InvitationSerializer(many=True)


class GroupListSerializer(serializers.Serializer[Any]):
    """The user's groups."""

    items = GroupSerializer(many=True)
