"""Serializers of the OpenAPI document that only projects use."""

from __future__ import annotations

from rest_framework import serializers

from backend.core.rest.openapi import ProblemSerializer
from backend.projects.api.serializers import ConflictSerializer


class ConflictProblemSerializer(ProblemSerializer):
    """A stale base; both versions of each file are in `conflicts`."""

    revision = serializers.IntegerField(required=False)
    conflicts = ConflictSerializer(many=True, required=False)
