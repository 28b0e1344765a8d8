"""History, restoring, drafts, import and export, and the old names of the API."""

from __future__ import annotations

import io
import json
import stat
import zipfile
from datetime import timedelta

import pytest
from django.utils import timezone

from backend.projects.models import Blob, Draft, Project
from backend.projects.storage import writes
from backend.workers import zips
from tests.backend.projects.api.test_views import file


@pytest.fixture
def edited(api, project):
    """A project with three revisions: added, changed, deleted and another added."""
    pid = project["id"]
    api.save(pid, file("a.txt", 0, "one\ntwo\n"), message="Add")
    api.save(pid, file("a.txt", 2, "one\n2\n"), message="Change")
    api.save(pid, file("a.txt", 3, delete=True), file("b.bin", 0, content_base64="AAE="), message="Delete")
    return pid


def test_history_is_listed_in_pages_and_by_file(api, edited):
    everything = api.get(f"projects/{edited}/revisions")
    assert [(r["number"], r["message"]) for r in everything["items"]] == [
        (4, "Delete"),
        (3, "Change"),
        (2, "Add"),
        (1, "Create the project"),
    ]
    assert everything["items"][0]["author"] == "local"
    assert {f["path"]: f["change"] for f in everything["items"][0]["files"]} == {
        "a.txt": "deleted",
        "b.bin": "written",
    }
    page = api.get(f"projects/{edited}/revisions?limit=2")
    assert page["next_before"] == 3
    assert [r["number"] for r in api.get(f"projects/{edited}/revisions?before=3")["items"]] == [2, 1]
    assert [r["number"] for r in api.get(f"projects/{edited}/revisions?path=a.txt")["items"]] == [4, 3, 2]


def test_history_takes_a_number_of_queries_that_does_not_grow(api, edited, django_assert_max_num_queries):
    with django_assert_max_num_queries(4):
        api.get(f"projects/{edited}/revisions")


def test_a_file_is_found_as_it_was(api, edited):
    assert api.get(f"projects/{edited}/revisions/2/files/a.txt") == b"one\ntwo\n"
    assert api.get(f"projects/{edited}/revisions/3/files/a.txt") == b"one\n2\n"
    api.get(f"projects/{edited}/revisions/4/files/a.txt", expect=404)
    api.get(f"projects/{edited}/revisions/99/files/a.txt", expect=404)
    assert b"project" in api.get(f"projects/{edited}/revisions/4/files/project.json")


def test_two_revisions_are_compared(api, edited):
    (changed,) = api.get(f"projects/{edited}/revisions/3/diff")["files"]
    assert changed["change"] == "changed"
    assert "-two\n+2\n" in changed["diff"]
    kinds = {f["path"]: f["change"] for f in api.get(f"projects/{edited}/revisions/4/diff")["files"]}
    assert kinds == {"a.txt": "removed", "b.bin": "added"}
    (binary,) = [
        f for f in api.get(f"projects/{edited}/revisions/4/diff?against=3")["files"] if f["path"] == "b.bin"
    ]
    assert binary["diff"] is None
    assert len(api.get(f"projects/{edited}/revisions/1/diff")["files"]) == 2


def test_a_revision_is_restored_as_a_new_one(api, edited):
    restored = api.post(f"projects/{edited}/revisions/2/restore")
    assert restored["revision"] == 5
    assert {f["path"]: f["content"] for f in restored["files"]}["a.txt"] == "one\ntwo\n"
    assert "b.bin" not in {f["path"] for f in restored["files"]}
    again = api.post(f"projects/{edited}/revisions/4/restore", {"paths": ["b.bin"]})
    assert {"a.txt", "b.bin"} <= {f["path"] for f in again["files"]}
    api.post(f"projects/{edited}/revisions/4/restore", {"paths": ["none"]}, expect=404)


def test_restoring_keeps_the_name_of_the_project(api, edited):
    api.patch(f"projects/{edited}", {"base_revision": 4, "name": "Renamed"})
    api.post("projects", {"name": "Robot"}, expect=201)
    restored = api.post(f"projects/{edited}/revisions/1/restore")
    assert restored["name"] == restored["settings"]["name"] == "Renamed"


def test_a_revision_gets_a_name(api, edited):
    assert api.patch(f"projects/{edited}/revisions/2", {"label": " works "})["label"] == "works"
    assert api.get(f"projects/{edited}/revisions")["items"][2]["label"] == "works"
    api.patch(f"projects/{edited}/revisions/99", {"label": "x"}, expect=404)


def test_drafts_are_kept_apart_from_revisions_and_end_with_a_save(api, edited):
    api.put(f"projects/{edited}/drafts/c.txt", {"base_revision": 0, "content": "typed"})
    api.put(f"projects/{edited}/drafts/c.txt", {"base_revision": 0, "content": "typed more"})
    (draft,) = api.get(f"projects/{edited}/drafts")["items"]
    assert (draft["path"], draft["content"]) == ("c.txt", "typed more")
    assert api.get(f"projects/{edited}")["revision"] == 4
    api.delete(f"projects/{edited}/drafts/none.txt")
    api.save(edited, file("c.txt", 0, "saved"))
    assert api.get(f"projects/{edited}/drafts")["items"] == []
    api.put(f"projects/{edited}/drafts/../x", {"base_revision": 0, "content": ""}, expect=422)


def upload(api, data, *, expect, name="p.zip", **headers):
    stream = io.BytesIO(data)
    stream.name = name
    response = api.client.post("/api/v1/projects/import", {"file": stream}, headers=headers)
    assert response.status_code == expect, response.content
    return response.json()


def zipped(files, **options):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", **options) as archive_:
        for path, content in files.items():
            archive_.writestr(path, content)
    return stream.getvalue()


def test_export_and_import_give_the_same_files_and_bytes(api, edited):
    data = api.get(f"projects/{edited}/export")
    assert api.get(f"projects/{edited}/export") == data
    made = upload(api, data, expect=201)
    assert made["name"] == "Robot 2"
    assert {f["path"]: f["sha256"] for f in made["files"] if f["path"] != "project.json"} == {
        f["path"]: f["sha256"] for f in api.get(f"projects/{edited}")["files"] if f["path"] != "project.json"
    }


def test_an_import_offers_a_repair_and_makes_it_only_when_asked(api):
    tree = b'<root BTCPP_format="4"><BehaviorTree ID="M"><Script code="x := 1 & 1"/></BehaviorTree></root>'
    refused = upload(api, tree, expect=422, name="bare.xml")
    (offer,) = refused["diagnostics"]
    assert (offer["code"], offer["line"]) == ("BT0740", 1)
    assert offer["values"] == {"before": "&", "after": "&amp;", "value": "x := 1 & 1"}
    stream = io.BytesIO(tree)
    stream.name = "bare.xml"
    made = api.client.post("/api/v1/projects/import", {"file": stream, "repair": "true"})
    assert made.status_code == 201, made.content
    assert "trees/M.json" in {item["path"] for item in made.json()["files"]}


def test_an_import_takes_one_folder_off_and_leaves_junk_out(api):
    files = {
        "rover/project.json": '{"name": "Rover"}',
        "rover/a.txt": "x",
        "__MACOSX/x": "",
        "rover/__pycache__/y": "",
    }
    made = upload(api, zipped(files), expect=201)
    assert [f["path"] for f in made["files"]] == ["a.txt", "project.json"]


def test_an_import_may_be_repeated_with_its_key(api):
    data = zipped({"project.json": '{"name": "Once"}'})
    one = upload(api, data, expect=201, **{"Idempotency-Key": "i"})
    assert upload(api, data, expect=201, **{"Idempotency-Key": "i"})["id"] == one["id"]
    other = zipped({"project.json": '{"name": "Else"}'})
    upload(api, other, expect=422, **{"Idempotency-Key": "i"})


def link():
    entry = zipfile.ZipInfo("link")
    entry.external_attr = (stat.S_IFLNK | 0o777) << 16
    return entry


@pytest.mark.parametrize(
    ("files", "code"),
    [
        ({"project.json": "{}", "../evil.txt": "x"}, "invalid_input"),
        ({"project.json": "{}", "/etc/cron.d/x": "x"}, "invalid_input"),
        ({"project.json": "{}", "a/../../x": "x"}, "invalid_input"),
        ({"project.json": "{}", "C:\\x": "x"}, "invalid_input"),
        ({"project.json": "{}", link(): "/etc/passwd"}, "bad_archive"),
        ({"project.json": "{}", "a": "x", "A": "y"}, "invalid_input"),
        ({"project.json": "{"}, "invalid_input"),
        ({"readme.txt": "no project"}, "check_failed"),
        ({}, "bad_archive"),
    ],
)
def test_hostile_archives_are_refused_and_leave_nothing(api, files, code):
    assert upload(api, zipped(files), expect=422)["code"] == code
    assert api.get("projects")["items"] == []
    assert not Blob.objects.exists()


@pytest.mark.parametrize("data", [b"", b"no zip", b"PK\x03\x04" + bytes(100)])
def test_a_file_that_is_no_zip_is_refused(api, data):
    assert upload(api, data, expect=422)["code"] in {"bad_archive", "invalid_input"}


def test_a_bomb_is_not_unpacked(api, settings_of):
    settings_of(max_file_bytes=1_000_000, max_project_bytes=2_000_000, max_project_files=50)
    packed = {"compression": zipfile.ZIP_DEFLATED}
    one = zipped({"project.json": "{}", "big": bytes(30_000_000)}, **packed)
    many = zipped({"project.json": "{}"} | {f"f{n}": bytes(900_000) for n in range(4)}, **packed)
    crowd = zipped({"project.json": "{}"} | {f"f{n}": "" for n in range(60)})
    for bomb in (one, many, crowd):
        assert len(bomb) < 100_000
        assert upload(api, bomb, expect=413)["code"] == "quota_exceeded"


def test_a_header_that_lies_about_the_size_does_not_help(api, settings_of):
    settings_of(max_file_bytes=1000)
    data = bytearray(zipped({"project.json": "{}", "big": bytes(50_000)}, compression=zipfile.ZIP_DEFLATED))
    position = data.index(b"PK\x01\x02", data.index(b"PK\x01\x02") + 1)
    data[position + 24 : position + 28] = (10).to_bytes(4, "little")
    assert upload(api, bytes(data), expect=422)["code"] in {"bad_archive", "quota_exceeded"}


def test_packing_is_deterministic():
    assert zips.pack({"b": b"2", "a": b"1"}) == zips.pack({"a": b"1", "b": b"2"})


def test_garbage_goes_and_what_someone_can_reach_stays(api, edited):
    now = timezone.now()
    gone = api.post("projects", {"name": "Gone"}, expect=201)["id"]
    api.save(gone, file("only.txt", 0, "only here"))
    api.delete(f"projects/{gone}")
    api.put(f"projects/{edited}/drafts/c.txt", {"base_revision": 0, "content": "typed"})
    assert writes.collect_garbage(now=now) == 0
    assert writes.collect_garbage(now=now + timedelta(days=31)) > 0
    assert not Project.objects.filter(id=gone).exists()
    assert not Draft.objects.exists()
    assert api.get(f"projects/{edited}/revisions/2/files/a.txt") == b"one\ntwo\n"
    assert api.get(f"projects/{edited}/files/b.bin") == b"\x00\x01"


def test_the_old_names_of_the_api_answer(api):
    post = lambda name, expect=200, **asked: api.post(f"/tree_api/{name}/", asked, expect=expect)  # noqa: E731
    assert post("create_project", project_name="Old", expect=201) == {"success": True}
    assert api.get("/tree_api/get_project_list/") == {"project_list": ["Old"]}
    graph = api.get("/tree_api/get_project_graph/?project_name=Old")["graph_json"]
    assert json.loads(graph)["id"] == "MainTree"
    post("save_project_graph", project_name="Old", graph_json=graph)
    api.post("/tree_api/save_project", {"project_name": "Old", "graph_json": json.loads(graph)})
    post("create_file", project_name="Old", filename="Go.py", content="class Go: ...", expect=201)
    post("create_file", project_name="Old", filename="Go.py", content="other", expect=409)
    post("save_file", project_name="Old", filename="Go.py", content="class Go: pass")
    assert api.get("/tree_api/get_file_list/?project_name=Old") == {"file_list": ["Go.py"]}
    assert api.get("/tree_api/get_file/?project_name=Old&filename=Go.py") == {"content": "class Go: pass"}
    post("delete_file", project_name="Old", filename="Go.py")
    api.get("/tree_api/get_file/?project_name=Old&filename=Go.py", expect=404)
    post("delete_project", project_name="Old")
    assert api.get("/tree_api/get_project_list/") == {"project_list": []}


def test_old_calls_that_change_state_are_no_longer_get(api):
    for name in (
        "create_project",
        "delete_project",
        "save_project_graph",
        "create_file",
        "delete_file",
        "save_file",
    ):
        api.get(f"/tree_api/{name}/?project_name=x", expect=405)


def test_old_calls_are_checked_like_all(api, project):
    api.post("/tree_api/create_file/", {"project_name": "Robot", "filename": "../x.py"}, expect=422)
    api.post("/tree_api/create_file/", {"project_name": "Robot"}, expect=422)
    api.post("/tree_api/save_project_graph/", {"project_name": "Robot", "graph_json": "["}, expect=422)
    api.post("/tree_api/create_project/", {"project_name": 5}, expect=422)
    api.post("/tree_api/create_project/", [], expect=422)
    api.get("/tree_api/get_file_list/?project_name=None", expect=404)


def test_old_apps_are_zips(api):
    api.post("projects", {"template": "laser_bump_and_go", "name": "Bump"}, expect=201)
    for name in ("get_dockerized_app", "get_simplified_app"):
        assert api.get(f"/tree_api/{name}/?project_name=Bump&app_name=bump").startswith(b"PK")
    with zipfile.ZipFile(
        io.BytesIO(api.get("/tree_api/generate_app/?project_name=Bump&app_name=bump"))
    ) as package:
        assert "bump/package.xml" in package.namelist()


def test_a_package_is_previewed_and_downloaded(api):
    pid = api.post("projects", {"template": "laser_bump_and_go"}, expect=201)["id"]
    preview = api.get(f"projects/{pid}/package/preview?name=bump")
    assert preview["name"] == "bump"
    assert "<name>bump</name>" in preview["manifest"]
    with zipfile.ZipFile(io.BytesIO(api.get(f"projects/{pid}/package?name=bump"))) as package:
        assert sorted(package.namelist()) == [f["path"] for f in preview["files"]]
    assert api.get(f"projects/{pid}/package?dockerized=1").startswith(b"PK")
    assert api.get(f"projects/{pid}/package?name=No%20Name", expect=422)["code"] == "check_failed"


XML = (
    b'<root BTCPP_format="4"><BehaviorTree ID="Main">'
    b'<Sequence><Go speed="{v}"/></Sequence></BehaviorTree></root>'
)


def test_an_xml_becomes_a_project(api):
    made = upload(api, XML, expect=201, name="rover.xml")
    assert {"trees/Main.json", "actions/Go.py"} <= {f["path"] for f in made["files"]}
    assert made["main_tree"] == "Main"


def test_a_project_of_jderobot_is_recognised(api):
    root = {"id": "r", "type": "basic", "name": "Tree Root", "x": 0, "y": 0, "ports": []}
    graph = {"layers": [{"models": {}}, {"models": {"r": root}}]}
    data = zipped({"code/trees/main.json": json.dumps(graph), "code/actions/Go.py": "", "config.json": "{}"})
    made = upload(api, data, expect=201, name="old.zip")
    assert made["settings"]["format"] == "bt-studio/project"


@pytest.mark.parametrize(
    "data", [b"<root", b'<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><root>&a;</root>']
)
def test_hostile_xml_is_refused_with_diagnostics(api, data):
    assert upload(api, data, expect=422, name="x.xml")["diagnostics"]
