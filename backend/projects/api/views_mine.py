"""Views of a user's data on this server: its size, a download of all of it, and its deletion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import extend_schema
from rest_framework import serializers
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import parsed, user_of
from backend.accounts.api.serializers import DeleteMeSerializer
from backend.accounts.api.viewsets import ResourceViewSet
from backend.accounts.audit import note
from backend.accounts.writes import delete_account
from backend.config.environment import environment
from backend.core.file_answers import saved_as
from backend.core.problems import InvalidInputError, NotFoundError
from backend.projects.documents import personal_data
from backend.projects.signals import usage_asked
from backend.projects.storage import usage

if TYPE_CHECKING:
    from django.http.response import HttpResponseBase
    from rest_framework.request import Request


class UsageSerializer(serializers.Serializer[Any]):
    """The space that the user's projects and stored runs take, with its limits."""

    projects = serializers.IntegerField()
    max_projects = serializers.IntegerField()
    bytes = serializers.IntegerField()
    max_bytes = serializers.IntegerField()
    runs = serializers.IntegerField()
    run_bytes = serializers.IntegerField()
    max_run_bytes = serializers.IntegerField()


class Mine(ResourceViewSet):
    """The data of the user on this server."""

    @extend_schema(operation_id="get_my_usage", responses=UsageSerializer, tags=["accounts"])
    @action(detail=False)
    def usage(self, request: Request) -> Response:
        """Returns the number and the bytes of the user's projects and stored runs, with the limits."""
        user = user_of(request)
        found = usage.usage(user)
        for _, more in usage_asked.send(Mine, user=user):
            found |= cast("dict[str, int]", more)
        return Response(found)

    @extend_schema(
        operation_id="export_my_data",
        responses={(200, "application/zip"): OpenApiTypes.BINARY},
        tags=["accounts"],
    )
    @action(detail=False, expensive=("GET",))
    def data(self, request: Request) -> HttpResponseBase:
        """Returns the user's account, audit log, projects and stored runs as one zip."""
        user = user_of(request)
        note("account.export", actor=user)
        headers = {"Content-Type": "application/zip"} | saved_as(f"{user.username}.zip")
        return personal_data.answer_with_archive(self, request, user, headers)

    @extend_schema(
        operation_id="delete_my_account",
        request=DeleteMeSerializer,
        responses={204: None},
        tags=["accounts"],
    )
    @data.mapping.delete
    def delete_data(self, request: Request) -> Response:
        """Deletes the account with all its projects irreversibly.

        The body is `{"username": …}` with the user's name, as a confirmation.
        """
        user = user_of(request)
        if not environment().is_team:
            raise NotFoundError("There are no accounts on this server.")
        if parsed(DeleteMeSerializer, request.data)["username"] != user.username:
            raise InvalidInputError("This is not your name.", hint="Type it as it is.", field="username")
        delete_account(user)
        return Response(status=204)
