"""Views that convert trees between diagram and XML; nothing is stored."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from drf_spectacular.utils import extend_schema
from rest_framework import serializers
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import parsed
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.limits import LIMITS
from backend.core.rest.fields import StrictSerializer, TextField
from backend.projects.api import serializers as s
from backend.projects.documents import checking

if TYPE_CHECKING:
    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

MAX_TEXT = LIMITS["tree_text_characters"]


class WriteTreeSerializer(StrictSerializer):
    """A diagram that is to be converted to XML."""

    diagram = TextField(max_length=MAX_TEXT, help_text="Diagram JSON, as in trees/<TreeID>.json.")
    base = TextField(
        required=False, default="", max_length=MAX_TEXT, help_text="An earlier text, to be patched."
    )
    ids = serializers.ListField(
        child=TextField(max_length=LIMITS["name_characters"]),
        required=False,
        default=list,
        max_length=LIMITS["nodes_per_tree"],
        help_text="The nodes of `base`, in the order of the text.",
    )


class ReadTreeSerializer(StrictSerializer):
    """An edited XML text of a tree."""

    xml = TextField(max_length=MAX_TEXT)
    diagram = TextField(max_length=MAX_TEXT, help_text="The diagram before the text was edited.")


class NodeRangeSerializer(serializers.Serializer[Any]):
    """The range of a node in the text. Offsets are in UTF-16 code units, and each line ends with one unit."""

    node = serializers.CharField()
    start = serializers.IntegerField()
    open_end = serializers.IntegerField(help_text="Behind its start tag.")
    end = serializers.IntegerField()


class TreeTextSerializer(serializers.Serializer[Any]):
    """The XML of one tree."""

    xml = serializers.CharField()
    ranges = NodeRangeSerializer(many=True)


class ReadTreeDoneSerializer(TreeTextSerializer):
    """The tree that was read from a text."""

    diagram = serializers.CharField(allow_null=True, help_text="null: the text cannot be read.")
    diagnostics = s.DiagnosticSerializer(many=True)


class Trees(ResourceViewSet):
    """Conversions of trees between diagram and XML; nothing is stored."""

    @extend_schema(
        operation_id="write_tree_xml",
        request=WriteTreeSerializer,
        responses=TreeTextSerializer,
        tags=["trees"],
    )
    # Users who may read a project may also read its trees as text: with POST, since a diagram is long.
    @action(detail=False, methods=["post"], open_to_guests=True, guests_post=True)
    def xml(self, request: Request) -> HttpResponseBase:
        """Converts one diagram to BT.CPP v4 XML. Comments and blanks of an earlier text are kept."""
        asked = parsed(WriteTreeSerializer, request.data)
        return checking.answered(self, request, "write_tree", Response, **asked)

    @extend_schema(
        operation_id="read_tree_xml",
        request=ReadTreeSerializer,
        responses=ReadTreeDoneSerializer,
        tags=["trees"],
    )
    @action(detail=False, methods=["post"])
    def diagram(self, request: Request) -> HttpResponseBase:
        """Converts the XML of one tree to a diagram. Nodes keep their ids.

        If the XML cannot be read, `diagnostics` holds the reasons.
        """
        asked = parsed(ReadTreeSerializer, request.data)
        return checking.answered(self, request, "read_tree", Response, **asked)
