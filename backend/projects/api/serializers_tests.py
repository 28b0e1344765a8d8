"""Serializers of the results of behaviour tests."""

from __future__ import annotations

from typing import Any

from rest_framework import serializers

from backend.projects.api.serializers import DiagnosticSerializer


class TestPathSerializer(serializers.Serializer[Any]):
    """A node on the way from the root, with its status after the tick."""

    name = serializers.CharField()
    status = serializers.CharField()


class TestFailureSerializer(serializers.Serializer[Any]):
    """The reason for which a behaviour test failed."""

    message = serializers.CharField()
    line = serializers.IntegerField(help_text="Line of the expectation in the file.")
    tick = serializers.IntegerField(help_text="From 1; 0 before the first tick.")
    time_s = serializers.FloatField()
    node = serializers.CharField(help_text="Path of the node; empty if it is about no single node.")
    tree = serializers.CharField()
    node_id = serializers.CharField(help_text="Id of the node in the diagram.")
    wanted = serializers.CharField()
    got = serializers.CharField()
    path = TestPathSerializer(many=True)


class TestOutcomeSerializer(serializers.Serializer[Any]):
    """The outcome of one behaviour test."""

    name = serializers.CharField()
    file = serializers.CharField()
    line = serializers.IntegerField()
    tree = serializers.CharField(help_text="Empty for the main tree.")
    outcome = serializers.ChoiceField(choices=["passed", "failed", "needs_python", "not_run"])
    ticks = serializers.IntegerField()
    failures = TestFailureSerializer(many=True)
    reached = serializers.DictField(
        child=serializers.DictField(child=serializers.ListField(child=serializers.CharField())),
        help_text="What the test reached: items by tree and node.",
    )


class CoveredNodeSerializer(serializers.Serializer[Any]):
    """The items of a node that tests can reach, each with whether one did."""

    name = serializers.CharField()
    type = serializers.CharField()
    items = serializers.DictField(child=serializers.BooleanField())


class CoveredTreeSerializer(serializers.Serializer[Any]):
    """The coverage of one tree, by node id."""

    share = serializers.FloatField()
    nodes = serializers.DictField(child=CoveredNodeSerializer())


class CoverageSerializer(serializers.Serializer[Any]):
    """The coverage of all trees, by tree id."""

    share = serializers.FloatField()
    trees = serializers.DictField(child=CoveredTreeSerializer())


class TestReportSerializer(serializers.Serializer[Any]):
    """The results of a project's behaviour tests."""

    tests = TestOutcomeSerializer(many=True)
    problems = DiagnosticSerializer(many=True)
    coverage = CoverageSerializer()
