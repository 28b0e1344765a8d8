"""Who one is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from drf_spectacular.utils import extend_schema
from rest_framework import serializers
from rest_framework.response import Response
from rest_framework.views import APIView

from backend import __version__
from backend.config.api import user_of

if TYPE_CHECKING:
    from rest_framework.request import Request


class MeSerializer(serializers.Serializer[Any]):
    """The user and the server."""

    mode = serializers.ChoiceField(choices=["local"])
    user = serializers.CharField()
    version = serializers.CharField()


class Me(APIView):
    """Who one is."""

    @extend_schema(operation_id="get_me", responses=MeSerializer, tags=["accounts"])
    def get(self, request: Request) -> Response:
        """The user, how they came in, and the version of the server."""
        return Response({"mode": "local", "user": user_of(request).username, "version": __version__})
