"""The catalogue over HTTP."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

from drf_spectacular.utils import extend_schema
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.catalog import queries
from backend.catalog import serializers as s
from backend.projects.templates import templates

if TYPE_CHECKING:
    from rest_framework.request import Request


class Nodes(APIView):
    """Built-in nodes."""

    @extend_schema(operation_id="list_nodes", responses=s.NodesSerializer, tags=["catalog"])
    def get(self, request: Request) -> Response:
        """Every built-in node with its ports."""
        return Response(queries.nodes())


class Universes(APIView):
    """Built-in worlds."""

    @extend_schema(operation_id="list_universes", responses=s.EntryListSerializer, tags=["catalog"])
    def get(self, request: Request) -> Response:
        """Every built-in universe."""
        return Response({"items": queries.universes()})


class Robots(APIView):
    """Built-in robots."""

    @extend_schema(operation_id="list_robots", responses=s.EntryListSerializer, tags=["catalog"])
    def get(self, request: Request) -> Response:
        """Every built-in robot."""
        return Response({"items": queries.robots()})


class Templates(APIView):
    """Projects that new ones start from."""

    @extend_schema(operation_id="list_templates", responses=s.TemplateListSerializer, tags=["catalog"])
    def get(self, request: Request) -> Response:
        """The empty project and the examples."""
        return Response({"items": [asdict(template) for template in templates()]})
