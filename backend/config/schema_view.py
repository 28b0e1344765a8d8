"""The views of the OpenAPI document."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode

from django.conf import settings
from django.http import HttpResponseRedirect
from django.shortcuts import render
from django.views.decorators.http import require_safe
from drf_spectacular.utils import extend_schema
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.identity import identify

if TYPE_CHECKING:
    from django.http import HttpRequest, HttpResponse
    from rest_framework.request import Request


@lru_cache(maxsize=1)
def document() -> dict[str, Any]:
    """Returns the OpenAPI document of this version."""
    # Imported at the first request for the document, so that the server starts faster.
    from drf_spectacular.generators import SchemaGenerator  # noqa: PLC0415

    from backend.accounts.api import schema  # noqa: F401, PLC0415 - importing it registers it

    generated: dict[str, Any] = SchemaGenerator().get_schema(  # type: ignore[no-untyped-call]
        request=None, public=True
    )
    return generated


@require_safe
def docs(request: HttpRequest) -> HttpResponse:
    """Shows the document as a page to browse and try; it works without the internet.

    Anonymous users must sign in first.
    """
    if identify(request.COOKIES) is None:
        return HttpResponseRedirect(f"{settings.LOGIN_URL}?{urlencode({'next': request.path})}")
    return render(request, "config/api_docs.html")


class OpenApi(APIView):
    """The view of the OpenAPI document."""

    @extend_schema(exclude=True)
    def get(self, request: Request) -> Response:
        """Returns the OpenAPI 3.1 document of the API."""
        return Response(document())
