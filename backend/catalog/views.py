"""Views of the catalogue."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

from django.http import HttpResponse
from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import parsed
from backend.accounts.api.viewsets import ResourceViewSet
from backend.catalog import library, offered, queries
from backend.catalog import serializers as s
from backend.core.problems import NotFoundError
from backend.projects.documents.templates import templates
from translator.ros_interfaces import interface_fields, interface_names

if TYPE_CHECKING:
    from pathlib import Path

    from rest_framework.request import Request


class Nodes(APIView):
    """Built-in nodes."""

    open_to_guests = True

    @extend_schema(operation_id="list_nodes", responses=s.NodesSerializer, tags=["catalog"])
    def get(self, request: Request) -> Response:
        """Lists every built-in node with its ports."""
        return Response(queries.nodes())


class Interfaces(ResourceViewSet):
    """The interfaces of ROS that are installed on this server."""

    lookup_url_kwarg = "interface"
    lookup_value_converter = "path"
    open_to_guests = True

    @extend_schema(operation_id="list_interfaces", responses=s.InterfaceListSerializer, tags=["catalog"])
    def list(self, request: Request) -> Response:
        """Lists every installed interface: messages, services and actions."""
        names = interface_names()
        return Response({"items": [{"name": name, "kind": kind} for name, kind in names]})

    @extend_schema(operation_id="get_interface", responses=s.InterfaceSerializer, tags=["catalog"])
    def retrieve(self, request: Request, interface: str) -> Response:
        """Returns the fields of an interface, each as a port of a block."""
        fields = interface_fields(interface)
        if fields is None:
            raise NotFoundError(f"There is no interface {interface!r} on this server.")
        return Response({"name": interface, "ports": [asdict(field) for field in fields]})


class Universes(ResourceViewSet):
    """Built-in universes."""

    lookup_url_kwarg = "universe_id"
    open_to_guests = True

    @extend_schema(operation_id="list_universes", responses=s.EntryListSerializer, tags=["catalog"])
    def list(self, request: Request) -> Response:
        """Lists every built-in universe."""
        return Response({"items": queries.universes()})

    @extend_schema(
        operation_id="get_universe_preview",
        responses={(200, "image/webp"): OpenApiTypes.BINARY},
        tags=["catalog"],
    )
    @action(detail=True)
    def preview(self, request: Request, universe_id: str) -> HttpResponse:
        """Returns a picture of the universe, 480 × 270 pixels."""
        return _picture(queries.universe_preview(universe_id), f"universe {universe_id!r}")

    @extend_schema(
        operation_id="get_universe_text",
        responses={(200, "application/yaml"): OpenApiTypes.STR},
        tags=["catalog"],
    )
    @action(detail=True)
    def text(self, request: Request, universe_id: str) -> HttpResponse:
        """Returns the YAML of the universe, which a project can copy and change."""
        path = queries.universe_text(universe_id)
        return _text(path, "application/yaml", f"There is no world {universe_id!r}.")


class Robots(ResourceViewSet):
    """Built-in robots."""

    lookup_url_kwarg = "robot_id"
    open_to_guests = True

    @extend_schema(operation_id="list_robots", responses=s.EntryListSerializer, tags=["catalog"])
    def list(self, request: Request) -> Response:
        """Lists every built-in robot."""
        return Response({"items": queries.robots()})

    @extend_schema(
        operation_id="get_robot_preview",
        responses={(200, "image/webp"): OpenApiTypes.BINARY},
        tags=["catalog"],
    )
    @action(detail=True)
    def preview(self, request: Request, robot_id: str) -> HttpResponse:
        """Returns a picture of the robot, 480 × 270 pixels."""
        return _picture(queries.robot_preview(robot_id), f"robot {robot_id!r}")

    @extend_schema(
        operation_id="get_robot_config",
        responses={(200, "application/yaml"): OpenApiTypes.STR},
        tags=["catalog"],
    )
    @action(detail=True)
    def config(self, request: Request, robot_id: str) -> HttpResponse:
        """Returns the `robot.yaml` of the robot, which a project can copy and change."""
        return _text(queries.robot_config(robot_id), "application/yaml", f"There is no robot {robot_id!r}.")

    @extend_schema(
        operation_id="get_robot_urdf",
        responses={(200, "text/xml"): OpenApiTypes.STR},
        tags=["catalog"],
    )
    @action(detail=True)
    def urdf(self, request: Request, robot_id: str) -> HttpResponse:
        """Returns the URDF of the robot, which the browser needs to draw it."""
        return _text(queries.robot_urdf(robot_id), "text/xml", f"There is no robot {robot_id!r}.")


class Templates(APIView):
    """Templates of new projects."""

    open_to_guests = True

    @extend_schema(operation_id="list_templates", responses=s.TemplateListSerializer, tags=["catalog"])
    def get(self, request: Request) -> Response:
        """Lists the empty project and the examples."""
        return Response({"items": [asdict(template) for template in templates()]})


class Behaviours(APIView):
    """Behaviours that projects can reuse."""

    open_to_guests = True

    @extend_schema(operation_id="list_behaviours", responses=s.BehaviourListSerializer, tags=["catalog"])
    def get(self, request: Request) -> Response:
        """Lists the built-in library, with every file of each behaviour."""
        return Response({"items": [asdict(behaviour) for behaviour in library.behaviours()]})


class OfferedActions(APIView):
    """Actions that the palette offers."""

    open_to_guests = True

    @extend_schema(
        operation_id="list_offered_actions",
        parameters=[s.OfferedQuerySerializer],
        responses=s.OfferedActionListSerializer,
        tags=["catalog"],
    )
    def get(self, request: Request) -> Response:
        """Lists the nodes of Nav2 in a ROS distribution, each with the source that a project takes."""
        asked = parsed(s.OfferedQuerySerializer, request.query_params.dict())
        return Response({"items": offered.offered_actions(asked["ros_distro"])})


def _text(path: Path | None, content_type: str, missing: str) -> HttpResponse:
    if path is None or not path.is_file():
        raise NotFoundError(missing)
    return HttpResponse(path.read_bytes(), content_type=f"{content_type}; charset=utf-8")


def _picture(path: Path | None, what: str) -> HttpResponse:
    if path is None or not path.is_file():
        raise NotFoundError(f"There is no picture of a {what}.")
    response = HttpResponse(path.read_bytes(), content_type="image/webp")
    response.headers["Cache-Control"] = "private, max-age=3600"
    return response
