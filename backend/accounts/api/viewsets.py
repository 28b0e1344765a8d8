"""The base of views that are grouped by resource, and the router that gives them their addresses."""

from __future__ import annotations

from typing import Any

from rest_framework.routers import SimpleRouter
from rest_framework.viewsets import ViewSet

from backend.core.rest.openapi import ProblemSchema


class ResourceSchema(ProblemSchema):
    """Describes the answer of `list` operations, which is an object with `items`, not an array."""

    def _is_list_view(self, serializer: Any = None) -> bool:
        return False


class ResourceViewSet(ViewSet):
    """All operations on one kind of resource.

    `@action` can change an attribute for its own operation only if the class has that attribute. The
    permission and throttle classes in `backend.accounts.permissions` read the three attributes of this class.
    """

    schema = ResourceSchema()
    expensive: tuple[str, ...] = ()
    open_to_guests = False
    guests_post = False


def resource_router() -> SimpleRouter:
    """Returns a router for paths without a final slash, written with Django's path converters."""
    return SimpleRouter(trailing_slash=False, use_regex_path=False)
