"""The trees that projects offer, and who finds them."""

from __future__ import annotations

import json

import pytest

from backend.projects.storage import cache, offers
from tests.backend.accounts.conftest import person, team  # noqa: F401 - fixtures
from tests.backend.accounts.test_sharing import project_of


def tree(name, *nodes, offered=True):
    """A file with a tree of these blocks."""
    blocks = {f"n{n}": node for n, node in enumerate(nodes)}
    attributes = {"attributes": {"_bts_offered": "1"}} if offered else {}
    content = json.dumps({"id": name, "root": "n0", "nodes": blocks, **attributes})
    return {"path": f"trees/{name}.json", "base_revision": 0, "content": content}


def action(name, text=""):
    return {"path": f"actions/{name}.py", "base_revision": 0, "content": f"class {name}:\n    pass\n{text}"}


def found(user, start=0, end=9):
    return offers.offers(user, start, end)[0]


def test_an_offered_tree_comes_with_all_that_it_uses(api, project, user):
    api.save(
        project["id"],
        tree("Dock", {"type": "SubTree", "tree": "Approach"}, {"type": "Park"}),
        tree("Approach", {"type": "Drive"}, {"type": "SubTree", "tree": "Dock"}, offered=False),
        action("Park", "from Brake import Brake\n"),
        action("Brake"),
        action("Drive"),
        action("Other"),
    )
    [offer] = found(user)
    assert (str(offer.project.id), offer.trees) == (project["id"], ["Dock"])
    assert sorted(offer.files) == [
        "actions/Brake.py",
        "actions/Drive.py",
        "actions/Park.py",
        "trees/Approach.json",
        "trees/Dock.json",
    ]


def test_what_is_not_offered_or_cannot_be_read_is_left_out(api, project, user):
    api.save(
        project["id"],
        tree("Mine", {"type": "Sequence"}, offered=False),
        {"path": "trees/Broken.json", "base_revision": 0, "content": '{"_bts_offered": "1"'},
        {"path": "trees/List.json", "base_revision": 0, "content": '["_bts_offered"]'},
        {"path": "notes.txt", "base_revision": 0, "content": "_bts_offered"},
    )
    assert found(user) == []
    api.save(project["id"], tree("Odd", "no block", {"type": "SubTree"}))
    [offer] = found(user)
    assert sorted(offer.files) == ["trees/Odd.json"]


def test_a_page_counts_projects_the_newest_first(api, user):
    for name in ("First", "Second"):
        made = api.post("projects", {"name": name}, expect=201)
        api.save(made["id"], tree("Dock", {"type": "Sequence"}))
    page, total = offers.offers(user, 0, 1)
    assert ([offer.project.name for offer in page], total) == (["Second"], 2)
    assert [offer.project.name for offer in found(user, 1, 2)] == ["First"]


def test_offers_are_found_by_those_who_may_read_the_project(person):  # noqa: F811
    olga, fred, eve = person("olga"), person("fred"), person("eve")
    one = project_of(olga)
    olga.save(one, tree("Dock", {"type": "Sequence"}))
    olga.post(f"projects/{one}/shares", {"name": "fred", "role": "viewer"})
    assert [[str(offer.project.id) for offer in found(who.user)] for who in (olga, fred, eve)] == [
        [one],
        [one],
        [],
    ]
    olga.delete(f"projects/{one}/shares/people/fred")
    assert found(fred.user) == []
    olga.post(f"projects/{one}/archive")
    assert found(olga.user) == []


def test_the_list_reads_no_more_than_offers_may_use(api, project, user, monkeypatch):
    one, read = project["id"], []
    fetch = cache.contents
    monkeypatch.setattr(cache, "contents", lambda hashes: read.append(fetch(list(hashes))) or read[-1])
    large = action("Large", "# " + "x" * 1_000_000)
    api.save(one, tree("Dock", {"type": "Park"}), action("Park"), large)
    read.clear()
    assert sorted(found(user)[0].files) == ["actions/Park.py", "trees/Dock.json"]
    assert sum(len(data) for round_ in read for data in round_.values()) < 1000
    park = {**action("Park", "from Large import Large\n"), "base_revision": 2}
    api.save(one, park)
    read.clear()
    assert found(user) == []
    assert sum(len(data) for round_ in read for data in round_.values()) < 1000


@pytest.mark.parametrize(("name", "value"), [("LARGEST", 400), ("MOST_FILES", 2)])
def test_a_project_that_offers_too_much_is_left_out_and_others_are_not(api, user, monkeypatch, name, value):
    large, small = (api.post("projects", {"name": each}, expect=201)["id"] for each in ("Large", "Small"))
    api.save(large, tree("Dock", *[{"type": "Sequence"}] * 100), action("One"))
    api.save(small, tree("Dock", {"type": "Sequence"}))
    assert [offer.project.name for offer in found(user)] == ["Small", "Large"]
    monkeypatch.setattr(offers, name, value)
    assert [offer.project.name for offer in found(user)] == ["Small"]


def test_trees_that_offered_ones_use_are_found_at_any_depth_and_in_a_ring(api, project, user):
    ring = [tree(f"T{n}", {"type": "SubTree", "tree": f"T{(n + 1) % 12}"}, offered=n == 0) for n in range(12)]
    api.save(project["id"], *ring)
    assert sorted(found(user)[0].files) == sorted(file["path"] for file in ring)


def test_a_file_that_is_no_text_is_left_out_and_asked_for_once(api, project, user, monkeypatch):
    chain = [tree(f"T{n}", {"type": "SubTree", "tree": f"T{n + 1}"}, offered=n == 0) for n in range(5)]
    bytes_ = {"path": "actions/Park.py", "base_revision": 0, "content_base64": "AP8A" * 100}
    api.save(project["id"], *chain, tree("T5", {"type": "Park"}), bytes_)
    asked, fetch = [], cache.contents
    monkeypatch.setattr(cache, "contents", lambda hashes: asked.append(fetch(list(hashes))) or asked[-1])
    assert sorted(found(user)[0].files) == [f"trees/T{n}.json" for n in range(6)]
    assert sum(any(len(data) == 300 for data in round_.values()) for round_ in asked) == 1
