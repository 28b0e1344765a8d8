"""Robots, worlds and maps come into a project by REST: one revision each, or nothing."""

from __future__ import annotations

import tempfile
from urllib.parse import urlencode

import pytest

from backend.core.limits import LIMITS
from backend.imports import views
from backend.imports.errors import ImportUnavailableError
from executor.robots import load_robot
from tests.executor.expansion.probes import probes, robot_of, was_refused
from tests.executor.uploads.zips import CART, MAP, MESH, PACKAGE, WORLD, zipped


@pytest.fixture
def door(api, project):
    """Sends an upload to the project."""

    def send(data, what="", *, expect=201, key="", **query):
        query.setdefault("filename", "upload.zip")
        path = f"/api/v1/projects/{project['id']}/imports{what}?{urlencode(query, doseq=True)}"
        headers = {"Idempotency-Key": key} if key else {}
        [kind] = views.UPLOAD
        response = api.client.generic("POST", path, data, content_type=kind, headers=headers)
        assert response.status_code == expect, response.content
        return response.json()

    return send


@pytest.fixture
def now(api, project):
    """Returns the project as it is stored."""
    return lambda: api.call("GET", f"projects/{project['id']}")


def test_a_robot_of_a_workspace_is_one_revision_with_its_report(door, now, api, project, tmp_path):
    upload = zipped(PACKAGE, {"ws/out.stl": "/etc/passwd"})
    looked = door(upload, "/inspect", expect=200)
    [item] = looked["items"]
    assert item["path"] == "ws/cart/urdf/cart.urdf.xacro"
    assert (item["kind"], item["source"], item["name"], item["is_main"]) == ("robot", "xacro", "cart", True)
    assert item["arguments"] == [{"name": "top", "default": "lid"}]
    [left] = looked["left_out"]
    assert (left["file"], "not followed" in left["text"]) == ("ws/out.stl", True)

    made = door(upload, kind="robot", main=item["path"], arg=["top:=roof"], use="true", key="k")
    assert (made["revision"], made["previous_revision"]) == (2, 1)
    assert made["path"] == "robots/cart/robot.yaml"
    assert made["test_drive"]["fits"]
    places = [(line["file"].rpartition("/")[2], line["text"]) for line in made["report"]["left_out"]]
    assert ("cart.urdf.xacro", "<extra> is not read") in places
    found = now()
    assert (found["revision"], found["settings"]["robot"]) == (2, "cart")
    for path in made["paths"]:
        raw = api.client.get(f"/api/v1/projects/{project['id']}/files/{path}").content
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(raw)
    assert (tmp_path / "robots/cart/meshes/lid.stl").read_bytes() == MESH
    assert "roof" in load_robot("cart", tmp_path).urdf.links

    again = door(upload, kind="robot", main=item["path"], arg=["top:=roof"], use="true", key="k")
    assert again == made
    refused = door(upload, kind="robot", expect=409)
    assert (refused["code"], refused["field"], refused["name"]) == ("name_taken", "name", "cart_2")
    assert door(upload, "/inspect", expect=200)["items"][0]["name"] == "cart_2"
    replaced = door(CART.encode(), kind="robot", name="cart", filename="cart.urdf", replace="true")
    assert replaced["removed"] == ["robots/cart/meshes/lid.stl"]
    assert now()["revision"] == 3


def test_a_world_and_a_map_become_universes(door, now):
    made = door(zipped(WORLD), kind="universe", use="true")
    assert made["paths"] == ["assets/yard/meshes/a.stl", "universes/yard.yaml"]
    assert (made["things"], made["test_drive"], made["can_simplify"]) == (1, None, False)
    line = {"file": "shop/worlds/yard.sdf", "line": 1, "text": "<physics> has no counterpart here"}
    assert line in made["report"]["left_out"]
    assert now()["universe"] == "yard"
    assert door(zipped(MAP), kind="universe", name="flat")["path"] == "universes/flat.yaml"


def test_an_upload_has_a_largest_size(door, monkeypatch):
    monkeypatch.setitem(LIMITS, "import_upload_bytes", 5)
    assert door(b"<robot/>", "/inspect", expect=413)["code"] == "quota_exceeded"


REFUSED = [
    ({"data": zipped(PACKAGE)[:-40], "kind": "robot"}, "bad_archive", "not a zip"),
    ({"data": b"", "kind": "robot"}, "invalid_input", "No file"),
    ({"data": zipped(PACKAGE), "kind": "robot", "name": "../x"}, "invalid_input", "A name has letters"),
    ({"data": zipped(PACKAGE), "kind": "robot", "arg": "top=lid"}, "invalid_input", "name:=value"),
    (
        {"data": zipped({"a/b.zip": zipped(PACKAGE)}), "kind": "universe"},
        "import_choice",
        "nothing of this kind",
    ),
    (
        {"data": zipped({"a/r.urdf": b"<robot name='r'>\n<link"}), "kind": "robot"},
        "import_refused",
        "a/r.urdf:2:",
    ),
]


@pytest.mark.parametrize(("asked", "code", "text"), REFUSED, ids=[row[2][:20] for row in REFUSED])
def test_what_cannot_be_imported_is_one_sentence_and_nothing_is_written(door, now, asked, code, text):
    asked = dict(asked)
    problem = door(asked.pop("data"), expect=422, **asked)
    assert problem["code"] == code
    assert text in problem["detail"]
    assert problem["hint"] or code != "import_choice"
    assert tempfile.gettempdir() not in str(problem)
    assert now()["revision"] == 1


def test_what_a_robot_file_tries_is_refused_and_said(door, now, tmp_path):
    secret = tmp_path / "secret.yaml"
    secret.write_text("word: hidden\n")
    for text in probes(secret):
        problem = door(text.encode(), kind="robot", filename="r.xacro", expect=422)
        assert problem["code"] == "import_refused"
        [found] = problem["diagnostics"]
        assert (found["file"], found["line"]) == ("r.xacro", 2)
        assert was_refused(found["message"])
    assert now()["revision"] == 1


def test_the_check_looks_at_robots_with_macros_where_there_is_a_process(api, project, tmp_path, monkeypatch):
    (tmp_path / "secret.yaml").write_text("word: hidden\n")
    probe, *_ = probes(tmp_path / "secret.yaml")
    saved = api.save(
        project["id"],
        *(
            {"path": path, "base_revision": 0, "content": data.decode()}
            for path, data in robot_of(probe).items()
        ),
    )
    [note] = [found for found in saved["diagnostics"] if found["code"] == "BT0915"]
    assert (note["file"], note["severity"]) == ("robots/r/r.xacro", "note")
    check = f"projects/{project['id']}/check"
    found = api.post(check, {"files": []})["diagnostics"]
    assert [item["code"] for item in found if item["code"].startswith("BT091")] == ["BT0916"]
    [error] = [item for item in found if item["code"] == "BT0916"]
    assert (error["file"], error["line"], error["severity"]) == ("robots/r/r.xacro", 2, "error")
    assert was_refused(error["message"])
    typed = [{"path": "robots/r/r.xacro", "content": f"\n{probe}"}]
    [error] = [item for item in api.post(check, {"files": typed})["diagnostics"] if item["code"] == "BT0916"]
    assert error["line"] == 3

    def none(*_):
        raise ImportUnavailableError("There is none.")

    monkeypatch.setattr("backend.imports.robots.runner", none)
    codes = [item["code"] for item in api.post(check, {"files": []})["diagnostics"]]
    assert "BT0915" in codes
    assert "BT0916" not in codes
