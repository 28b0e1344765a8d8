"""Views of the user's own account and of groups."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db import transaction
from drf_spectacular.utils import extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response
from rest_framework.views import APIView

from backend import __version__
from backend.accounts import groups, invitations
from backend.accounts.api import serializers as s
from backend.accounts.api.requests import parsed, user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.config.environment import environment

if TYPE_CHECKING:
    from uuid import UUID

    from rest_framework.request import Request

    from backend.accounts.models import User


class Me(APIView):
    """The user's own account."""

    open_to_guests = True

    @extend_schema(operation_id="get_me", responses=s.MeSerializer, tags=["accounts"])
    def get(self, request: Request) -> Response:
        """Returns the user, their rights, and the version of the server."""
        user = user_of(request)
        return Response(
            {
                "mode": environment().mode,
                "user": user.username,
                "name": user.get_full_name(),
                "email": user.email,
                "role": _role(user),
                "version": __version__,
                "users_run_as_server": environment().users_run_as_server,
            }
        )


def _role(user: User) -> str:
    if not environment().is_team:
        return "local"
    if user.is_guest:
        return "guest"
    return "administrator" if user.is_superuser else "teacher" if user.is_teacher else "user"


class Groups(ResourceViewSet):
    """Groups such as classes."""

    lookup_url_kwarg = "group_id"
    lookup_value_converter = "uuid"

    @extend_schema(operation_id="list_groups", responses=s.GroupListSerializer, tags=["accounts"])
    def list(self, request: Request) -> Response:
        """Lists the groups that the user made, and those of which the user is a member."""
        user = user_of(request)
        return Response({"items": [groups.presented(row, user=user) for row in groups.groups_of(user)]})

    @extend_schema(
        operation_id="create_group",
        request=s.NamedSerializer,
        responses={201: s.GroupSerializer},
        tags=["accounts"],
    )
    @transaction.atomic  # includes the reads for the answer
    def create(self, request: Request) -> Response:
        """Makes a group. Only teachers and administrators may make groups."""
        asked = parsed(s.NamedSerializer, request.data)
        user = user_of(request)
        made = groups.create(asked["name"], acting_user=user)
        return Response(groups.presented(made, user=user), status=201)

    @extend_schema(operation_id="get_group", responses=s.GroupSerializer, tags=["accounts"])
    def retrieve(self, request: Request, group_id: UUID) -> Response:
        """Returns a group; its managers also get the members and invitations."""
        user = user_of(request)
        return Response(groups.presented(groups.group(group_id, user=user), user=user))

    @extend_schema(
        operation_id="rename_group",
        request=s.NamedSerializer,
        responses=s.GroupSerializer,
        tags=["accounts"],
    )
    @transaction.atomic  # includes the reads for the answer
    def partial_update(self, request: Request, group_id: UUID) -> Response:
        """Renames a group."""
        asked = parsed(s.NamedSerializer, request.data)
        user = user_of(request)
        found = groups.rename(group_id, asked["name"], acting_user=user)
        return Response(groups.presented(found, user=user))

    @extend_schema(operation_id="delete_group", responses={204: None}, tags=["accounts"])
    def destroy(self, request: Request, group_id: UUID) -> Response:
        """Removes the group; accounts and projects stay."""
        groups.delete(group_id, acting_user=user_of(request))
        return Response(status=204)

    @extend_schema(operation_id="remove_group_member", responses={204: None}, tags=["accounts"])
    @action(detail=True, methods=["delete"], url_path="members/<str:username>")
    def remove_member(self, request: Request, group_id: UUID, username: str) -> Response:
        """Removes a member from the group. Every member may leave it."""
        groups.remove_member(group_id, username, acting_user=user_of(request))
        return Response(status=204)

    @extend_schema(
        operation_id="invite_to_group",
        request=s.InviteSerializer,
        responses={201: s.InvitationSerializer},
        tags=["accounts"],
    )
    @action(detail=True, methods=["post"], url_path="invitations")
    @transaction.atomic  # includes the reads for the answer
    def invite(self, request: Request, group_id: UUID) -> Response:
        """Makes a link with which people create accounts and join."""
        asked = parsed(s.InviteSerializer, request.data)
        user = user_of(request)
        found = groups.group(group_id, user=user, own=True)
        made = invitations.invite(
            acting_user=user, group=found, days=asked["days"], max_uses=asked["max_uses"]
        )
        return Response(groups.presented_invitation(made), status=201)


class OneInvitation(APIView):
    """One invitation link."""

    @extend_schema(operation_id="revoke_invitation", responses={204: None}, tags=["accounts"])
    def delete(self, request: Request, invitation_id: UUID) -> Response:
        """Revokes the link. Users who joined with it stay."""
        invitations.revoke(invitation_id, acting_user=user_of(request))
        return Response(status=204)
