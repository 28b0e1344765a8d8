"""Content negotiation.

Each endpoint has one representation, so `Accept` is ignored and never causes a 406.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rest_framework.negotiation import BaseContentNegotiation
from rest_framework.utils.mediatypes import media_type_matches

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rest_framework.renderers import BaseRenderer
    from rest_framework.request import Request


class IgnoreClientNegotiation(BaseContentNegotiation):
    """Selects the first renderer, and the parser by the body's content type."""

    def select_parser(self, request: Request, parsers: Iterable[Any]) -> Any:
        """Returns the parser of this content type; DRF answers 415 if there is none."""
        return next((p for p in parsers if media_type_matches(p.media_type, request.content_type)), None)

    def select_renderer(
        self, request: Request, renderers: Iterable[BaseRenderer], format_suffix: str | None = None
    ) -> tuple[BaseRenderer, str]:
        """Returns the first renderer of the endpoint."""
        renderer = next(iter(renderers))
        return renderer, str(renderer.media_type)
