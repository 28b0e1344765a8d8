"""The view of the trees that projects offer in the library."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from drf_spectacular.utils import extend_schema
from rest_framework import serializers
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import parsed, user_of
from backend.projects.api.serializers import MAX_REVISION
from backend.projects.documents import checking
from backend.projects.storage import offers

if TYPE_CHECKING:
    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.projects.storage.offers import Offer


class OffersQuerySerializer(serializers.Serializer[Any]):
    """The query of the list; it counts projects."""

    limit = serializers.IntegerField(required=False, default=20, min_value=1, max_value=50)
    offset = serializers.IntegerField(required=False, default=0, min_value=0, max_value=MAX_REVISION)


class OfferSerializer(serializers.Serializer[Any]):
    """The trees that one project offers to others."""

    project = serializers.UUIDField()
    name = serializers.CharField()
    description = serializers.CharField(allow_blank=True)
    owner = serializers.CharField()
    revision = serializers.IntegerField()
    main_tree = serializers.CharField()
    trees = serializers.ListField(child=serializers.CharField(), help_text="The offered trees.")
    files = serializers.DictField(
        child=serializers.CharField(), help_text="The trees and actions that they use, by path."
    )


class OfferListSerializer(serializers.Serializer[Any]):
    """A page of offers; `next_offset` is null on the last page."""

    items = OfferSerializer(many=True)
    next_offset = serializers.IntegerField(allow_null=True)


class Offers(APIView):
    """The trees that the user's projects offer."""

    @extend_schema(
        operation_id="list_offers",
        parameters=[OffersQuerySerializer],
        responses=OfferListSerializer,
        tags=["projects"],
    )
    def get(self, request: Request) -> HttpResponseBase:
        """Lists the trees that the user's own projects, and those shared with the user, offer to others.

        The projects are in the order of their last change, without archived ones, and those whose offered
        trees use more than 256 KB.
        """
        asked = parsed(OffersQuerySerializer, request.query_params.dict())
        end = asked["offset"] + asked["limit"]
        found = offers.Collecting(user_of(request), asked["offset"], end)

        def next_round() -> HttpResponseBase:
            if found.texts:
                return checking.answered(self, request, "uses", read, **found.texts)
            items = [_item(offer) for offer in found.offers]
            return Response({"items": items, "next_offset": end if end < found.total else None})

        def read(used: dict[str, Any]) -> HttpResponseBase:
            found.add(used)
            return next_round()

        return next_round()


def _item(offer: Offer) -> dict[str, Any]:
    project = offer.project
    return {
        "project": str(project.id),
        "name": project.name,
        "description": project.description,
        "owner": project.owner.username,
        "revision": project.revision,
        "main_tree": project.main_tree,
        "trees": offer.trees,
        "files": offer.files,
    }
