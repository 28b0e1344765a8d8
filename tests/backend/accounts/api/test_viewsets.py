"""The base of views by resource: paths, methods and attributes of single operations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.urls import resolve
from rest_framework.decorators import action
from rest_framework.response import Response
from rest_framework.test import APIRequestFactory

from backend.accounts.api.viewsets import ResourceSchema, ResourceViewSet, resource_router

if TYPE_CHECKING:
    from uuid import UUID

    from rest_framework.request import Request


class Boats(ResourceViewSet):
    authentication_classes = ()
    permission_classes = ()
    lookup_url_kwarg = "boat_id"
    lookup_value_converter = "uuid"

    def list(self, request: Request) -> Response:
        return Response({"items": []})

    @action(detail=True, methods=["post"], expensive=("POST",), guests_post=True)
    def launch(self, request: Request, boat_id: UUID) -> Response:
        return Response({"expensive": self.expensive, "guests_post": self.guests_post})

    @action(detail=False, url_path="files/<path:path>")
    def file(self, request: Request, path: str) -> Response:
        return Response({"path": path, "expensive": self.expensive, "guests_post": self.guests_post})


router = resource_router()
router.register("boats", Boats, basename="boats")
urlpatterns = router.urls
BOAT = "boats/3f2504e0-4f89-41d3-9a0c-000000000001"


def test_paths_have_no_final_slash_and_use_converters() -> None:
    assert {str(pattern.pattern) for pattern in urlpatterns} == {
        "boats",
        "boats/<uuid:boat_id>/launch",
        "boats/files/<path:path>",
    }


def test_an_operation_can_have_attributes_of_its_own() -> None:
    view, _, kwargs = resolve(f"/{BOAT}/launch", __name__)
    launched = view(APIRequestFactory().post("/"), **kwargs)
    assert launched.data == {"expensive": ("POST",), "guests_post": True}

    view, _, kwargs = resolve("/boats/files/a/b.txt", __name__)
    read = view(APIRequestFactory().get("/"), **kwargs)
    assert read.data == {"path": "a/b.txt", "expensive": (), "guests_post": False}


def test_a_method_that_no_operation_has_is_refused() -> None:
    view, _, _ = resolve("/boats", __name__)
    refused = view(APIRequestFactory().post("/"))
    assert refused.status_code == 405
    assert refused.headers["Allow"] == "GET, HEAD, OPTIONS"


def test_lists_are_described_as_objects() -> None:
    assert ResourceSchema()._is_list_view() is False
