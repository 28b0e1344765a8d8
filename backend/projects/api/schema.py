"""Serializers of the OpenAPI document that only projects use."""

from __future__ import annotations

from typing import Final

from rest_framework import serializers

from backend.core.rest.openapi import ProblemSerializer, problem_of
from backend.projects.api.serializers import ConflictSerializer, DiagnosticSerializer


class ConflictProblemSerializer(ProblemSerializer):
    """A stale base; both versions of each file are in `conflicts`."""

    revision = serializers.IntegerField(required=False)
    conflicts = ConflictSerializer(many=True, required=False)


class CheckProblemSerializer(ProblemSerializer):
    """A project or file with errors, or one that cannot be read; `diagnostics` say where."""

    diagnostics = DiagnosticSerializer(many=True, required=False)


NOT_SOUND: Final = problem_of(CheckProblemSerializer, "The project has errors.", status=422)
"""For the `responses` of operations that translate a project."""
