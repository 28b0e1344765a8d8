"""Answers of the catalogue."""

from __future__ import annotations

from typing import Any

from rest_framework import serializers

from backend.projects.serializers import ObjectField


class NodesSerializer(serializers.Serializer[Any]):
    """`tree_gardener/catalog.json`."""

    format = serializers.CharField()
    version = serializers.IntegerField()
    nodes = serializers.ListField(child=ObjectField())


class NamedSerializer(serializers.Serializer[Any]):
    """Something to choose."""

    id = serializers.CharField()
    name = serializers.CharField()
    description = serializers.CharField()


class EntrySerializer(NamedSerializer):
    """A universe or a robot; `preview` is the address of its picture, WebP of 480 by 270 pixels."""

    preview = serializers.CharField()


class EntryListSerializer(serializers.Serializer[Any]):
    """Universes or robots."""

    items = EntrySerializer(many=True)


class TemplateSerializer(NamedSerializer):
    """A project that new ones start from."""

    universe = serializers.CharField()
    root_diagram = ObjectField(allow_null=True)


class TemplateListSerializer(serializers.Serializer[Any]):
    """Templates, the empty project first."""

    items = TemplateSerializer(many=True)
