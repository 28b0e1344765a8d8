"""Serializers of the OpenAPI document that only projects use."""

from __future__ import annotations

from typing import Final

from rest_framework import serializers

from backend.core.rest.openapi import ProblemSerializer, problem_of
from backend.projects.api.serializers import ConflictSerializer, DiagnosticSerializer


class ConflictProblemSerializer(ProblemSerializer):
    """A conflict: a stale base. `conflicts` holds both versions of each file."""

    revision = serializers.IntegerField(required=False)
    conflicts = ConflictSerializer(many=True, required=False)


class CheckProblemSerializer(ProblemSerializer):
    """A project or file that has errors or cannot be read.

    `diagnostics` holds the errors with their places.
    """

    diagnostics = DiagnosticSerializer(many=True, required=False)


NOT_SOUND: Final = problem_of(CheckProblemSerializer, "The project has errors.", status=422)
"""The entry in `responses` of operations that translate a project."""
