"""The parts of the OpenAPI document that all operations share."""

from __future__ import annotations

from typing import Any, Literal

from drf_spectacular.openapi import AutoSchema
from drf_spectacular.utils import OpenApiParameter, OpenApiResponse
from rest_framework import serializers

from backend.core.problems import MEDIA_TYPE


class ProblemSerializer(serializers.Serializer[Any]):
    """An error as a problem document (RFC 9457)."""

    type = serializers.CharField()
    title = serializers.CharField()
    status = serializers.IntegerField()
    code = serializers.CharField(help_text="Stable; programs go by it.")
    detail = serializers.CharField(help_text="One sentence for the user.")
    hint = serializers.CharField(help_text="What to do now; may be empty.")
    field = serializers.CharField(required=False, help_text="The part of the request that is wrong.")


def problem_of(
    serializer: type[serializers.Serializer[Any]], description: str, *, status: int = 409
) -> dict[tuple[int, str], Any]:
    """Returns an entry for the `responses` of an operation: a problem document with additional members."""
    return {(status, MEDIA_TYPE): OpenApiResponse(serializer, description=description)}


class ProblemSchema(AutoSchema):
    """Adds the problem document to every operation, and names operations after their views."""

    def get_request_serializer(self) -> Any:
        """Returns the serializer of the body; for a DELETE only if the view declares one."""
        return None if self.method == "DELETE" else super().get_request_serializer()

    def _get_request_body(self, direction: Literal["request", "response"] = "request") -> Any:
        if self.method != "DELETE":
            return super()._get_request_body(direction)  # type: ignore[no-untyped-call]
        # The base class assumes that a DELETE never has a body.
        serializer = self.get_request_serializer()
        if serializer is None:
            return None
        component = self.resolve_serializer(serializer, direction)
        return {"content": {"application/json": {"schema": component.ref}}, "required": True}

    def _get_response_bodies(self, direction: Literal["request", "response"] = "response") -> Any:
        bodies = super()._get_response_bodies(direction)
        component = self.resolve_serializer(ProblemSerializer, "response")
        problem = {"content": {MEDIA_TYPE: {"schema": component.ref}}, "description": "A problem document."}
        bodies.setdefault("default", problem)
        return bodies


def _header(name: str, description: str) -> OpenApiParameter:
    return OpenApiParameter(name, str, OpenApiParameter.HEADER, description=description)


IF_MATCH = _header("If-Match", "ETag of the revision that the write is based on; another one answers 412.")
IF_NONE_MATCH = _header(
    "If-None-Match", "ETag of the revision that the client has; the same one answers 304."
)
IDEMPOTENCY_KEY = _header(
    "Idempotency-Key", "Makes the request safe to repeat: one effect, the first answer."
)
DIRECT = OpenApiResponse(
    description="To browsers alone, where BT_STUDIO_OBJECT_STORE_PUBLIC is set: an address of the object "
    "store for this one file, valid for 60 s."
)
