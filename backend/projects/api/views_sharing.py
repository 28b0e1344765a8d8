"""Views about sharing. Every answer is the complete list of people, groups and links."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from django.db import transaction
from drf_spectacular.utils import extend_schema
from rest_framework import serializers
from rest_framework.decorators import action
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import if_match, parsed, user_of
from backend.accounts.api.serializers import PersonSerializer
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.rest.openapi import IF_MATCH
from backend.projects.choices import SHARED_ROLES, Role
from backend.projects.sharing import memberships, transfer
from backend.projects.storage import queries
from backend.projects.storage.access import Need

if TYPE_CHECKING:
    from uuid import UUID

    from rest_framework.request import Request

    from backend.projects.models import Project

ROLES = [role.label for role in SHARED_ROLES]


class SharedRoleSerializer(serializers.Serializer[Any]):
    """The role of a person or group."""

    role = serializers.ChoiceField(choices=ROLES)


class SharePersonSerializer(SharedRoleSerializer):
    """A person, and their new role."""

    name = serializers.CharField(max_length=254, help_text="Name or e-mail address of an account.")


class TransferSerializer(serializers.Serializer[Any]):
    """The person who becomes the owner."""

    name = serializers.CharField(max_length=254, help_text="Name or e-mail address of an editor.")


class MakeLinkSerializer(serializers.Serializer[Any]):
    """The lifetime of a link."""

    days = serializers.IntegerField(min_value=1, max_value=3650, allow_null=True, default=None)


class SharedPersonSerializer(PersonSerializer):
    """A person with their role."""

    role = serializers.ChoiceField(choices=ROLES)


class SharedGroupSerializer(serializers.Serializer[Any]):
    """A group with the role of its members."""

    id = serializers.UUIDField()
    name = serializers.CharField()
    role = serializers.ChoiceField(choices=ROLES)


class LinkSerializer(serializers.Serializer[Any]):
    """A read-only link."""

    id = serializers.UUIDField()
    url = serializers.CharField()
    expires_at = serializers.DateTimeField(allow_null=True)
    created_at = serializers.DateTimeField()


class SharesSerializer(serializers.Serializer[Any]):
    """Everyone with whom a project is shared."""

    owner = PersonSerializer()
    people = SharedPersonSerializer(many=True)
    groups = SharedGroupSerializer(many=True)
    links = LinkSerializer(many=True)


def _answer(project: Project, status: int = 200) -> Response:
    document = memberships.shares(project)
    return Response(document, status=status, headers={"ETag": memberships.etag(document)})


class Shares(ResourceViewSet):
    """The people, groups and links with which a project is shared."""

    @extend_schema(operation_id="get_shares", responses=SharesSerializer, tags=["sharing"])
    def list(self, request: Request, project_id: UUID) -> Response:
        """Lists the people, groups and links. Only the owner may see them."""
        return _answer(queries.project(project_id, user=user_of(request), need=Need.MANAGE))

    @extend_schema(
        operation_id="share_with_person",
        parameters=[IF_MATCH],
        request=SharePersonSerializer,
        responses={200: SharesSerializer},
        tags=["sharing"],
    )
    @transaction.atomic  # includes the reads for the answer
    def create(self, request: Request, project_id: UUID) -> Response:
        """Gives a person a role in the project, or changes the role."""
        asked = parsed(SharePersonSerializer, request.data)
        role = Role[asked["role"].upper()]
        user, tag = user_of(request), if_match(request)
        return _answer(
            memberships.share_with_person(project_id, asked["name"], role, acting_user=user, if_match=tag)
        )

    @extend_schema(
        operation_id="unshare_with_person", parameters=[IF_MATCH], responses={204: None}, tags=["sharing"]
    )
    @action(detail=False, methods=["delete"], url_path="people/<str:username>")
    def unshare_with_person(self, request: Request, project_id: UUID, username: str) -> Response:
        """Removes the role of a person. Users can remove their own role."""
        user, tag = user_of(request), if_match(request)
        memberships.unshare_with_person(project_id, username, acting_user=user, if_match=tag)
        return Response(status=204)

    @extend_schema(
        operation_id="share_with_group",
        parameters=[IF_MATCH],
        request=SharedRoleSerializer,
        responses=SharesSerializer,
        tags=["sharing"],
    )
    @action(detail=False, methods=["put"], url_path="groups/<uuid:group_id>")
    @transaction.atomic  # includes the reads for the answer
    def share_with_group(self, request: Request, project_id: UUID, group_id: UUID) -> Response:
        """Gives a role to all members of a group."""
        role = Role[parsed(SharedRoleSerializer, request.data)["role"].upper()]
        user, tag = user_of(request), if_match(request)
        return _answer(
            memberships.share_with_group(project_id, group_id, role, acting_user=user, if_match=tag)
        )

    @extend_schema(
        operation_id="unshare_with_group", parameters=[IF_MATCH], responses={204: None}, tags=["sharing"]
    )
    @share_with_group.mapping.delete
    def unshare_with_group(self, request: Request, project_id: UUID, group_id: UUID) -> Response:
        """Removes the role of a group."""
        user, tag = user_of(request), if_match(request)
        memberships.unshare_with_group(project_id, group_id, acting_user=user, if_match=tag)
        return Response(status=204)

    @extend_schema(
        operation_id="make_share_link",
        parameters=[IF_MATCH],
        request=MakeLinkSerializer,
        responses={201: SharesSerializer},
        tags=["sharing"],
    )
    @action(detail=False, methods=["post"], url_path="links")
    @transaction.atomic  # includes the reads for the answer
    def make_link(self, request: Request, project_id: UUID) -> Response:
        """Makes a link with which anyone can read the project."""
        asked = parsed(MakeLinkSerializer, request.data)
        user, tag = user_of(request), if_match(request)
        return _answer(
            memberships.make_link(project_id, acting_user=user, days=asked["days"], if_match=tag), 201
        )

    @extend_schema(
        operation_id="revoke_share_link", parameters=[IF_MATCH], responses={204: None}, tags=["sharing"]
    )
    @action(detail=False, methods=["delete"], url_path="links/<uuid:link_id>")
    def revoke_link(self, request: Request, project_id: UUID, link_id: UUID) -> Response:
        """Revokes the link immediately, also for those who have opened it."""
        user, tag = user_of(request), if_match(request)
        memberships.revoke_link(project_id, link_id, acting_user=user, if_match=tag)
        return Response(status=204)


class Transfer(APIView):
    """Changes the owner of a project."""

    @extend_schema(
        operation_id="transfer_project",
        parameters=[IF_MATCH],
        request=TransferSerializer,
        responses=SharesSerializer,
        tags=["sharing"],
    )
    @transaction.atomic  # includes the reads for the answer
    def post(self, request: Request, project_id: UUID) -> Response:
        """Makes an editor the owner; the previous owner becomes an editor."""
        asked = parsed(TransferSerializer, request.data)
        user, tag = user_of(request), if_match(request)
        return _answer(transfer.transfer_project(project_id, asked["name"], acting_user=user, if_match=tag))
