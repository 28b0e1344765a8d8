"""Trees do not grow beyond the limits, in whatever way they arrive; larger ones are not lost."""

from __future__ import annotations

import json

import pytest

from backend.core.limits import LIMITS
from backend.projects.models import Blob
from backend.projects.storage import bounds, cache, queries, writes
from translator import limits
from translator.diagram import restore

pytestmark = pytest.mark.django_db(transaction=True)


def diagram(name, nodes, *, pad=""):
    leaves = {f"n{n}": {"type": "AlwaysSuccess", "name": pad} for n in range(nodes - 1)}
    rows = {"r": {"type": "Sequence", "children": list(leaves)}, **leaves}
    return json.dumps({"format": "bt-studio/diagram", "version": 1, "id": name, "root": "r", "nodes": rows})


def tree(name, nodes, base=0, **more):
    return {"path": f"trees/{name}.json", "base_revision": base, "content": diagram(name, nodes, **more)}


@pytest.fixture
def small(monkeypatch):
    for name, value in {"nodes_per_tree": 8, "nodes_per_project": 20, "trees_per_project": 4}.items():
        monkeypatch.setitem(LIMITS, name, value)


@pytest.fixture
def one(api):
    return api.post("projects", {"name": "Robot"}, expect=201)["id"]  # with an empty tree


@pytest.mark.parametrize(
    ("sizes", "is_taken"),
    [
        ((8,), True),
        ((9,), False),
        ((8, 8), True),
        ((8, 8, 4), True),
        ((8, 8, 5), False),
        ((2, 2, 2), True),
        ((1, 1, 1, 1), False),
    ],
)
def test_a_save_is_refused_that_makes_trees_too_large(api, one, small, sizes, is_taken):
    files = [tree(f"T{n}", size) for n, size in enumerate(sizes)]
    answer = api.save(one, *files, expect=200 if is_taken else 413)
    if not is_taken:
        assert answer["code"] == "quota_exceeded"
        assert answer["hint"]
        assert api.get(f"projects/{one}")["revision"] == 1


@pytest.mark.parametrize(
    "written",
    [
        lambda text: text.replace('"type"', '"t\\u0079pe"'),
        lambda text: text.replace('"nodes"', '"n\\u006fdes"'),
        lambda text: "\ufeff" + text,
        lambda text: json.dumps(json.loads(text), indent=4),
    ],
)
def test_nodes_are_counted_however_they_are_written(api, one, small, written):
    """A save refuses a tree that the translator would refuse, and no other."""
    for nodes, status in ((9, 413), (8, 200)):
        content = written(diagram("MainTree", nodes))
        file = {"path": "trees/MainTree.json", "base_revision": 1, "content": content}
        api.save(one, file, expect=status)
        found, _ = restore(content.encode(), file="trees/MainTree.json")
        assert len(found.nodes) == nodes


def test_bytes_of_all_trees_are_bounded(api, one, monkeypatch):
    monkeypatch.setitem(LIMITS, "diagram_bytes_per_project", 2000)
    api.save(one, tree("T", 2, pad="x" * 1000))
    assert api.save(one, tree("U", 2, pad="x" * 1000), expect=413)["code"] == "quota_exceeded"


def test_what_is_no_tree_is_not_counted(api, one, small):
    many = json.dumps({"nodes": {f"n{n}": {"type": "A"} for n in range(50)}})
    api.save(one, {"path": "assets/data.json", "base_revision": 0, "content": many})
    # A word that also occurs in nodes does not count as a node.
    odd = json.loads(diagram("Odd", 2)) | {"ports": [{"name": "p", "type": "int"}] * 30}
    api.save(one, {"path": "trees/Odd.json", "base_revision": 0, "content": json.dumps(odd)})


def test_what_exists_and_is_too_large_can_be_opened_made_smaller_and_downloaded(api, one, monkeypatch):
    api.save(one, tree("Large", 30), tree("Other", 5))
    for name, value in {"nodes_per_tree": 8, "nodes_per_project": 20}.items():
        monkeypatch.setitem(LIMITS, name, value)
    opened = api.get(f"projects/{one}")
    assert len(opened["files"]) == 4
    assert api.get(f"projects/{one}/export")[:2] == b"PK"
    assert api.save(one, tree("Large", 31, base=2), expect=413)["code"] == "quota_exceeded"
    api.save(one, {"path": "actions/Go.py", "base_revision": 0, "content": "x = 1\n"})
    api.save(one, tree("Large", 29, base=2))  # still too large, and smaller
    api.save(one, {"path": "trees/Other.json", "base_revision": 2, "delete": True})
    api.save(one, tree("Large", 8, base=4))
    api.post(f"projects/{one}/revisions/4/restore", {}, expect=413)


def test_an_import_is_bounded_as_a_save_is(user, small):
    from backend.projects.errors import QuotaExceededError

    with pytest.raises(QuotaExceededError):
        writes.create_project({"trees/T.json": diagram("T", 9).encode()}, acting_user=user)


def test_small_trees_are_not_even_looked_at(api, one, monkeypatch):
    monkeypatch.setattr(bounds._Contents, "_data", lambda *_: pytest.fail("a tree was read"))
    api.save(one, tree("T", 200))


def test_the_server_and_the_translator_have_one_table():
    assert {row.name: row.value for row in limits.TABLE.values()} == LIMITS


def test_large_main_trees_make_no_picture_and_are_not_read_for_a_list(api, one, monkeypatch):
    monkeypatch.setattr(queries, "LARGEST_DRAWN", 5000)
    assert api.get("projects")["items"][0]["root_diagram"] is not None
    api.save(one, tree("MainTree", 200, base=1))
    largest = Blob.objects.order_by("-size").first()
    monkeypatch.setattr(
        cache,
        "contents",
        lambda wanted: pytest.fail("it was read") if largest.sha256 in list(wanted) else {},
    )
    assert api.get("projects")["items"][0]["root_diagram"] is None
