"""Serializers of the catalogue."""

from __future__ import annotations

from typing import Any

from rest_framework import serializers

from backend.core.rest.fields import ObjectField
from backend.projects.api.serializers import ActionSerializer
from translator.nav2.distributions import DEFAULT, DISTRIBUTIONS


class NodesSerializer(serializers.Serializer[Any]):
    """The nodes of `tree_gardener/catalog.json`."""

    format = serializers.CharField()
    version = serializers.IntegerField()
    nodes = serializers.ListField(child=ObjectField())


class InterfaceNameSerializer(serializers.Serializer[Any]):
    """An interface of ROS."""

    name = serializers.CharField(help_text="Such as `nav2_msgs/action/NavigateToPose`.")
    kind = serializers.ChoiceField(choices=["action", "msg", "srv"])


class InterfaceListSerializer(serializers.Serializer[Any]):
    """Interfaces, sorted by name."""

    items = InterfaceNameSerializer(many=True)


class FieldSerializer(serializers.Serializer[Any]):
    """A field of an interface, as a port."""

    port = serializers.CharField(help_text="Its path, such as `goal__pose__pose__position__x`.")
    direction = serializers.ChoiceField(choices=["input", "output"])
    type = serializers.CharField(help_text="As in the catalogue of nodes; `any` for messages.")
    ros = serializers.CharField(help_text="As ROS writes it.")


class InterfaceSerializer(serializers.Serializer[Any]):
    """The fields of an interface; a message comes before its own fields."""

    name = serializers.CharField()
    ports = FieldSerializer(many=True)


class NamedSerializer(serializers.Serializer[Any]):
    """An item with a name in all languages."""

    id = serializers.CharField()
    name = serializers.CharField()
    description = serializers.CharField()


class EntrySerializer(NamedSerializer):
    """A universe or a robot. `preview` is the address of its picture, a WebP of 480 × 270 pixels, or ""."""

    preview = serializers.CharField(allow_blank=True)


class EntryListSerializer(serializers.Serializer[Any]):
    """Universes or robots."""

    items = EntrySerializer(many=True)


class TemplateSerializer(NamedSerializer):
    """A template of new projects."""

    universe = serializers.CharField()
    root_diagram = ObjectField(allow_null=True)
    conditions = serializers.ListField(
        child=serializers.CharField(),
        help_text="Types of the tree that are conditions.",
    )


class TemplateListSerializer(serializers.Serializer[Any]):
    """Templates, the empty project first."""

    items = TemplateSerializer(many=True)


class BehaviourSerializer(serializers.Serializer[Any]):
    """A behaviour to reuse: a subtree with ports. `summary` and `doc` hold a text for each language."""

    id = serializers.CharField(help_text="Also the name of its tree.")
    version = serializers.CharField()
    group = serializers.CharField(help_text="motion, navigation, vision, manipulation or ros.")
    universe = serializers.CharField(help_text="A built-in universe to try it in.")
    summary = serializers.DictField(child=serializers.CharField())
    doc = serializers.DictField(child=serializers.CharField())
    diagram = ObjectField(help_text="Its tree, with its ports.")
    files = serializers.DictField(
        child=serializers.CharField(), help_text="Every file that it needs, by its path in a project."
    )


class BehaviourListSerializer(serializers.Serializer[Any]):
    """The built-in library."""

    items = BehaviourSerializer(many=True)


class OfferedQuerySerializer(serializers.Serializer[Any]):
    """The parameters of the list of Nav2's nodes."""

    ros_distro = serializers.ChoiceField(choices=DISTRIBUTIONS, default=DEFAULT)


class OfferedActionSerializer(ActionSerializer):
    """A node of Nav2 as its source declares it, with the source."""

    text = serializers.CharField(help_text="The text of `path` in a project that takes the node.")


class OfferedActionListSerializer(serializers.Serializer[Any]):
    """The nodes of Nav2 that the palette offers."""

    items = OfferedActionSerializer(many=True)
