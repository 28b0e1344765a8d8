"""The list of offered trees."""

from __future__ import annotations

from backend.projects.api import views_offers
from tests.backend.projects.storage.test_offers import tree


def test_the_list_is_read_page_by_page(api):
    for name in ("First", "Second"):
        made = api.post("projects", {"name": name}, expect=201)
        api.save(made["id"], tree("Dock", {"type": "Sequence"}))
    page = api.get("projects/offers?limit=1")
    assert (page["items"][0]["name"], page["next_offset"]) == ("Second", 1)
    [item] = api.get("projects/offers?limit=1&offset=1")["items"]
    assert set(item) == set(views_offers.OfferSerializer().fields)
    assert (item["name"], item["trees"], list(item["files"])) == ("First", ["Dock"], ["trees/Dock.json"])
    assert api.get("projects/offers?limit=1&offset=1")["next_offset"] is None
    api.get("projects/offers?limit=0", expect=422)
