"""The projects API as the front end uses it."""

from __future__ import annotations

import base64
import json

import pytest

from backend.projects.documents import templates
from translator.nav2.sources import nav2_source


def file(path, base, content=None, **more):
    return {"path": path, "base_revision": base} | ({} if content is None else {"content": content}) | more


def test_a_project_of_an_example_has_its_files_actions_and_no_errors(api):
    made = api.post("projects", {"template": "laser_bump_and_go"}, expect=201)
    assert made["name"] == "Laser bump and go"
    assert made["settings"]["main_tree"] == made["main_tree"] == "MainTree"
    assert made["root_diagram"]["id"] == "MainTree"
    assert {a["name"] for a in made["actions"]} == {"CheckObstacle", "Forward", "Turn"}
    assert [d for d in made["diagnostics"] if d["severity"] == "error"] == []
    assert {f["path"]: f["revision"] for f in made["files"]}["actions/Turn.py"] == 1
    assert api.get(f"projects/{made['id']}") == made


def test_a_template_without_a_name_gets_a_free_one(api):
    names = [api.post("projects", {"template": "laser_bump_and_go"}, expect=201)["name"] for _ in range(2)]
    assert names == ["Laser bump and go", "Laser bump and go 2"]
    second = api.get("projects?sort=-created_at")["items"][0]
    assert api.get(f"projects/{second['id']}")["settings"]["name"] == "Laser bump and go 2"


def test_a_taken_name_is_refused_where_case_does_not_count(api, project):
    problem = api.post("projects", {"name": "ROBOT"}, expect=409)
    assert (problem["code"], problem["field"]) == ("name_taken", "name")
    assert problem["hint"]
    assert "Robot" not in problem["type"]


def test_every_template_makes_a_project_that_can_be_checked(api):
    for template in templates.templates():
        made = api.post("projects", {"template": template.id}, expect=201)
        # An empty project begins with a tree that has no block yet.
        assert (made["root_diagram"]["root"] is None) == (template.id == templates.EMPTY)


def test_an_unknown_template_lists_those_that_exist(api):
    problem = api.post("projects", {"template": "../backend"}, expect=422)
    assert problem["field"] == "template"
    assert "laser_bump_and_go" in problem["hint"]


def test_a_list_is_searched_and_sorted(api):
    for name in ("Beta", "alpha", "Gamma ray"):
        api.post("projects", {"name": name}, expect=201)
    listed = lambda query: [p["name"] for p in api.get(f"projects?{query}")["items"]]  # noqa: E731
    assert listed("sort=name") == ["alpha", "Beta", "Gamma ray"]
    assert listed("sort=-name") == ["Gamma ray", "Beta", "alpha"]
    assert listed("sort=-updated_at")[0] == "Gamma ray"
    assert listed("search=RAY%20gam") == ["Gamma ray"]
    assert listed("search=nothing") == []
    page = api.get("projects?sort=name&limit=2")
    assert (len(page["items"]), page["total"], page["next_offset"]) == (2, 3, 2)
    assert api.get("projects?sort=name&limit=2&offset=2")["next_offset"] is None
    assert api.get("projects?sort=size", expect=422)["field"] == "sort"


def test_a_list_takes_a_number_of_queries_that_does_not_grow(api, django_assert_max_num_queries):
    for number in range(5):
        api.post("projects", {"name": f"P{number}"}, expect=201)
    with django_assert_max_num_queries(4):
        assert len(api.get("projects")["items"]) == 5


def test_opening_takes_few_queries(api, project, django_assert_max_num_queries):
    api.save(project["id"], *(file(f"assets/{n}.txt", 0, "x") for n in range(50)))
    with django_assert_max_num_queries(5):
        assert len(api.get(f"projects/{project['id']}")["files"]) == 52


def test_saving_writes_several_files_as_one_revision(api, project):
    pid = project["id"]
    saved = api.save(
        pid, file("actions/A.py", 0, "a"), file("assets/b.bin", 0, content_base64="AAH/"), message="Add"
    )
    assert saved["revision"] == 2
    assert {f["path"]: f["revision"] for f in saved["files"]} == {
        "actions/A.py": 2, "assets/b.bin": 2, "project.json": 1, "trees/MainTree.json": 1,
    }  # fmt: skip
    files = {f["path"]: f for f in api.get(f"projects/{pid}")["files"]}
    assert files["actions/A.py"]["content"] == "a"
    assert files["assets/b.bin"]["content"] is None
    assert api.get(f"projects/{pid}/files/assets/b.bin") == b"\x00\x01\xff"


def test_a_stale_save_changes_nothing_and_shows_both_versions(api, project):
    pid = project["id"]
    api.save(pid, file("a.txt", 0, "first"))
    api.save(pid, file("a.txt", 2, "theirs"))
    problem = api.save(pid, file("a.txt", 2, "mine"), file("b.txt", 0, "new"), expect=409)
    assert problem["code"] == "revision_conflict"
    (conflict,) = problem["conflicts"]
    assert (conflict["path"], conflict["base_revision"]) == ("a.txt", 2)
    assert conflict["theirs"]["content"] == "theirs"
    assert conflict["theirs"]["revision"] == 3
    assert conflict["mine"]["content"] == "mine"
    assert [f["path"] for f in api.get(f"projects/{pid}")["files"]] == [
        "a.txt",
        "project.json",
        "trees/MainTree.json",
    ]
    assert api.save(pid, file("a.txt", 3, "merged"))["revision"] == 4


def test_a_base_may_be_the_revision_of_the_whole_project(api, project):
    api.save(project["id"], file("a.txt", 0, "1"))
    assert api.save(project["id"], file("project.json", 2, json.dumps(project["settings"])))["revision"] in {
        2,
        3,
    }


def test_a_base_from_the_future_is_refused(api, project):
    assert api.save(project["id"], file("a.txt", 99, "x"), expect=422)["field"] == "files.base_revision"


def test_a_repeated_save_is_no_conflict_and_no_revision(api, project):
    pid = project["id"]
    api.save(pid, file("a.txt", 0, "same"))
    assert api.save(pid, file("a.txt", 0, "same"))["revision"] == 2


def test_renaming_an_action_and_its_trees_is_one_change(api, project):
    pid = project["id"]
    api.save(pid, file("actions/A.py", 0, "class A: ..."))
    saved = api.save(pid, file("actions/A.py", 2, "class B: ...", rename_to="actions/B.py"), message="Rename")
    assert "actions/A.py" not in {f["path"] for f in saved["files"]}
    newest = api.get(f"projects/{pid}/revisions")["items"][0]
    assert newest["files"] == [{"path": "actions/B.py", "change": "renamed", "renamed_from": "actions/A.py"}]


@pytest.mark.parametrize("path", ["../x", "/x", "a\0", "con", "x/../../y", "C:\\x"])
def test_paths_that_climb_are_refused_everywhere(api, project, path):
    pid = project["id"]
    assert api.save(pid, file(path, 0, "x"), expect=422)["field"].endswith("path")
    assert api.save(pid, file("project.json", 1, rename_to=path), expect=422)["field"].endswith("rename_to")
    api.post(f"projects/{pid}/check", {"files": [{"path": path, "content": ""}]}, expect=422)


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"files": []},
        {"files": "x"},
        {"files": [{"path": "a"}]},
        {"files": [{"path": "a", "base_revision": "0", "content": "x"}]},
        {"files": [{"path": "a", "base_revision": 0, "content": 5}]},
        {"files": [{"path": "a", "base_revision": 0, "content_base64": "%%"}]},
        {"files": [{"path": "a", "base_revision": 0, "content": "x", "content_base64": "eA=="}]},
        {"files": [{"path": "a", "base_revision": 0, "content": "x", "contents": "x"}]},
        {"files": [{"path": "a", "base_revision": -1, "content": "x"}]},
        {"files": [{"path": "a", "base_revision": 0, "delete": "yes"}]},
        [],
        "x",
    ],
)
def test_malformed_changes_are_named(api, project, body):
    problem = api.post(f"projects/{project['id']}/changes", body, expect=422)
    assert problem["code"] == "invalid_input"
    assert problem["detail"]


@pytest.mark.parametrize("raw", ["{", "NaN", '{"name": NaN}', '{"name": "\\ud800"}', "[" * 100_000, "\xff"])
def test_bodies_that_are_no_json_are_refused(api, raw):
    response = api.client.generic(
        "POST", "/api/v1/projects", raw.encode("latin-1"), content_type="application/json"
    )
    assert response.status_code == 400
    assert response.json()["code"] == "parse_error"


def test_a_body_that_is_too_large_is_not_read(api, project, settings_of):
    settings_of(max_request_bytes=10_000)
    assert api.save(project["id"], file("a", 0, "x" * 10_000), expect=413)["code"] == "request_too_large"


def test_project_json_stays_a_project(api, project):
    pid = project["id"]
    for content in ("{", "[]", '{"name": 5}', '{"format": "other"}', '{"name": "a/b"}'):
        assert api.save(pid, file("project.json", 1, content), expect=422)["field"]
    api.save(pid, file("project.json", 1, delete=True), expect=422)
    api.save(pid, file("project.json", 1, rename_to="x.json"), expect=422)


def test_settings_are_edited_as_a_change_of_project_json(api, project):
    pid = project["id"]
    edited = api.patch(f"projects/{pid}", {"base_revision": 1, "name": "Rover", "description": "Drives."})
    assert (edited["name"], edited["settings"]["name"], edited["revision"]) == ("Rover", "Rover", 2)
    assert edited["settings"]["description"] == edited["description"] == "Drives."
    api.patch(f"projects/{pid}", {"base_revision": 1, "name": "Other"}, expect=409)
    settings = edited["settings"] | {"tick_hz": 5, "universe": "empty"}
    assert api.patch(f"projects/{pid}", {"base_revision": 2, "settings": settings})["universe"] == "empty"


def test_deleting_can_be_undone(api, project):
    pid = project["id"]
    api.delete(f"projects/{pid}")
    api.get(f"projects/{pid}", expect=404)
    assert [p["id"] for p in api.get("projects?shelf=deleted")["items"]] == [pid]
    api.post("projects", {"name": "Robot"}, expect=201)
    assert api.post(f"projects/{pid}/restore")["name"] == "Robot 2"
    assert api.get(f"projects/{pid}")["settings"]["name"] == "Robot 2"
    assert api.post(f"projects/{pid}/restore")["name"] == "Robot 2"


def test_an_archived_project_leaves_the_list(api, project):
    pid = project["id"]
    api.post(f"projects/{pid}/archive")
    assert api.get("projects")["items"] == []
    assert len(api.get("projects?shelf=archived")["items"]) == 1
    api.post(f"projects/{pid}/unarchive")
    assert len(api.get("projects")["items"]) == 1


def test_a_duplicate_has_the_files_and_its_own_history(api, project):
    api.save(project["id"], file("a.txt", 0, "x"))
    copy = api.post(f"projects/{project['id']}/duplicate", expect=201)
    assert (copy["name"], copy["revision"]) == ("Robot 2", 1)
    assert "a.txt" in {f["path"] for f in copy["files"]}


def test_checking_an_overlay_stores_nothing(api, project):
    tree = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "n1",
            "nodes": {"n1": {"type": "Nonsense"}}, "drafts": []}  # fmt: skip
    found = api.post(
        f"projects/{project['id']}/check",
        {"files": [{"path": "trees/MainTree.json", "content": json.dumps(tree)}]},
    )
    assert any(d["node"] == "n1" and d["severity"] == "error" for d in found["diagnostics"])
    assert api.get(f"projects/{project['id']}")["revision"] == 1


def test_xml_and_app_of_a_sound_project(api):
    pid = api.post("projects", {"template": "laser_bump_and_go"}, expect=201)["id"]
    assert b'BTCPP_format="4"' in api.get(f"projects/{pid}/xml")
    assert b"<Code>" in api.get(f"projects/{pid}/xml?self_contained=1")
    app = api.get(f"projects/{pid}/app")
    assert (app["universe"], app["tick_hz"], app["on_finish"], app["robot"]) == (
        "walled_room",
        20,
        "repeat",
        None,
    )
    assert base64.b64decode(app["app_zip_base64"]).startswith(b"PK")
    assert app["revision"] == api.get(f"projects/{pid}")["revision"]


def test_an_app_with_errors_says_which(api, project):
    problem = api.get(f"projects/{project['id']}/app", expect=422)
    assert problem["code"] == "check_failed"
    assert problem["diagnostics"][0]["code"]
    assert api.get(f"projects/{project['id']}/xml", expect=422)["diagnostics"]


def test_a_universe_of_the_project_goes_along(api):
    pid = api.post("projects", {"template": "laser_bump_and_go"}, expect=201)["id"]
    api.save(pid, file("universes/walled_room.yaml", 0, "name: mine\n"), file("assets/x.obj", 0, "o"))
    universe = api.get(f"projects/{pid}/app")["universe"]
    assert universe["document"] == "name: mine\n"
    assert universe["file"] == "universes/walled_room.yaml"
    assert universe["assets_zip_base64"]
    assert api.get(f"projects/{pid}/app?universe=house")["universe"] == "house"


def test_a_robot_of_the_project_goes_along_into_a_universe_that_we_ship(api):
    pid = api.post("projects", {"template": "laser_bump_and_go"}, expect=201)["id"]
    api.save(pid, file("robots/mine/robot.yaml", 0, "name: mine\n"))
    universe = api.get(f"projects/{pid}/app?universe=house")["universe"]
    assert universe["document"].startswith("format: bt-studio/universe")
    assert universe["assets_zip_base64"]
    assert api.get(f"projects/{pid}/app?universe=none")["universe"] == "none"
    assert api.get(f"projects/{pid}/app?universe=..%2Fhouse")["universe"] == "../house"


def test_etags_save_traffic_and_guard_writes(api, project):
    pid = project["id"]
    api.get(f"projects/{pid}")
    tag = api.response.headers["ETag"]
    api.get(f"projects/{pid}", expect=304, **{"If-None-Match": tag})
    api.save(pid, file("a.txt", 0, "x"), **{"If-Match": tag})
    assert (
        api.save(pid, file("b.txt", 0, "x"), expect=412, **{"If-Match": tag})["code"] == "precondition_failed"
    )
    api.delete(f"projects/{pid}", expect=412, **{"If-Match": tag})
    api.patch(f"projects/{pid}", {"base_revision": 1, "name": "X"}, expect=412, **{"If-Match": tag})
    api.post(f"projects/{pid}/revisions/1/restore", expect=412, **{"If-Match": tag})
    api.get(f"projects/{pid}")
    tag = api.response.headers["ETag"]
    api.post(f"projects/{pid}/archive")
    api.get(f"projects/{pid}", **{"If-None-Match": tag})
    api.get(f"projects/{pid}", **{"If-None-Match": tag})


def test_an_idempotency_key_makes_a_create_safe_to_repeat(api):
    key = {"Idempotency-Key": "k1"}
    one = api.post("projects", {"name": "Once"}, expect=201, **key)
    again = api.post("projects", {"name": "Once"}, expect=201, **key)
    assert again["id"] == one["id"]
    assert api.response.headers["Idempotency-Replayed"] == "true"
    assert len(api.get("projects")["items"]) == 1
    assert api.post("projects", {"name": "Else"}, expect=422, **key)["code"] == "idempotency_key_reused"
    api.post("projects", {"name": "Once"}, expect=409, **{"Idempotency-Key": "k2"})
    api.post("projects", {"name": "Free"}, expect=201, **{"Idempotency-Key": "k2"})


def test_limits_are_kept(api, project, settings_of):
    pid = project["id"]
    settings_of(max_file_bytes=5000, max_project_bytes=8000, max_project_files=4)
    assert api.save(pid, file("a", 0, "x" * 5001), expect=413)["code"] == "quota_exceeded"
    api.save(pid, file("a", 0, "x" * 5000))
    api.save(pid, file("b", 0, "x" * 4000), expect=413)
    api.save(pid, file("b", 0, ""))
    api.save(pid, file("c", 0, ""), expect=413)
    settings_of(max_user_projects=1)
    api.post("projects", {}, expect=413)
    settings_of(max_user_projects=5, max_user_bytes=100)
    api.post("projects", {}, expect=413)


def test_a_project_over_a_lowered_limit_may_still_shrink(api, project, settings_of):
    api.save(project["id"], file("a", 0, "x" * 5000))
    settings_of(max_project_bytes=1000, max_user_bytes=1000)
    api.save(project["id"], file("a", 2, "x" * 4000))


def test_downloads_never_run_as_a_page(api, project):
    api.save(project["id"], file("evil.svg", 0, "<svg onload='alert(1)'/>"))
    api.get(f"projects/{project['id']}/files/evil.svg")
    headers = api.response.headers
    assert headers["Content-Disposition"].startswith("attachment")
    assert "sandbox" in headers["Content-Security-Policy"]
    assert headers["Content-Type"] == "application/octet-stream"


def test_what_is_not_there_is_a_problem(api, project):
    missing = "00000000-0000-0000-0000-000000000000"
    for path in (
        f"projects/{missing}",
        f"projects/{project['id']}/files/none",
        f"sessions/{missing}",
        "nothing",
    ):
        assert api.get(path, expect=404)["code"] == "not_found"
    assert api.call("PUT", "projects", {}, expect=405)["code"] == "method_not_allowed"
    assert "POST" in api.response.headers["Allow"]


def test_an_action_is_inspected(api):
    source = "class Go:\n    '''Goes.'''\n"
    found = api.post("actions/inspect", {"source": source, "filename": "actions/Go.py"})
    assert found["name"] == "Go"


def test_a_change_of_the_distribution_answers_with_the_files_and_stores_nothing(api, project):
    url = f"projects/{project['id']}"
    tree = {
        "format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "a",
        "nodes": {"a": {"type": "ValidatePath", "ports": {"path": "{path}", "max_cost": "9"}}},
    }  # fmt: skip
    source = nav2_source("ValidatePath")
    files = [
        {"path": "trees/MainTree.json", "content": json.dumps(tree)},
        {"path": "actions/ValidatePath.py", "content": source},
    ]
    told = api.post(f"{url}/check", {"files": files})
    assert told["ros_distro"] == "jazzy"  # as the project says
    assert "BT0129" in {item["code"] for item in told["diagnostics"]}
    change = api.post(f"{url}/distribution", {"ros_distro": "kilted", "files": files})
    written = {item["path"]: item["content"] for item in change["files"]}
    assert written["actions/ValidatePath.py"] is None
    assert written["actions/IsPathValid.py"] == nav2_source("IsPathValid", "kilted")
    assert json.loads(written["trees/MainTree.json"])["nodes"]["a"]["type"] == "IsPathValid"
    assert json.loads(written["project.json"])["ros_distro"] == "kilted"
    assert (change["lacks"], change["kept"]) == ([], [])
    humble = api.post(f"{url}/distribution", {"ros_distro": "humble", "files": files})
    assert humble["lacks"] == ["max_cost of IsPathValid"]
    assert "actions/IsPathValid.py" not in api.get(url)["files"]
    problem = api.post(f"{url}/distribution", {"ros_distro": "foxy", "files": []}, expect=422)
    assert "foxy" in problem["detail"]
