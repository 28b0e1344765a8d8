"""The OpenAPI document."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

from drf_spectacular.utils import extend_schema
from rest_framework.response import Response
from rest_framework.views import APIView

if TYPE_CHECKING:
    from rest_framework.request import Request


@lru_cache(maxsize=1)
def document() -> dict[str, Any]:
    """The OpenAPI document of this version."""
    # Only whoever asks pays for importing the generator.
    from drf_spectacular.generators import SchemaGenerator  # noqa: PLC0415

    from backend.accounts import schema  # noqa: F401, PLC0415 - importing it registers it

    generated: dict[str, Any] = SchemaGenerator().get_schema(  # type: ignore[no-untyped-call]
        request=None, public=True
    )
    return generated


class OpenApi(APIView):
    """Describes itself."""

    @extend_schema(exclude=True)
    def get(self, request: Request) -> Response:
        """The OpenAPI 3.1 document of the API."""
        return Response(document())
