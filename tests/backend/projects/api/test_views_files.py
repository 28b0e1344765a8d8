"""Files that are taken from a project."""

from __future__ import annotations

import io
import zipfile

from backend.core import readers
from backend.core.file_answers import saved_as
from backend.core.readers import Reading, reading
from backend.projects.api.views_files import ORDERS, download
from tests.fakes.jderobot_projects import write_wanderer
from translator.jderobot import project


def test_a_file_and_the_whole_project_are_downloaded(api, project):
    one = project["id"]
    raw = api.client.get(f"/api/v1/projects/{one}/export").getvalue()
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        assert "project.json" in archive.namelist()
    assert api.get(f"projects/{one}/files/no.txt", expect=404)["code"] == "not_found"


def test_a_download_has_the_name_of_its_file():
    answer = download(b"x", "text/plain", "größe.txt")
    assert "attachment" in answer.headers["Content-Disposition"]
    assert saved_as("a.txt")


def test_an_import_of_several_trees_asks_for_the_main_one(api):
    tree = '<root BTCPP_format="4"><BehaviorTree ID="{}"><AlwaysSuccess/></BehaviorTree></root>'
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name in ("One", "Two"):
            archive.writestr(f"trees/{name}.xml", tree.format(name))
    address = "/api/v1/projects/import?filename=p.zip"

    def answer(more=""):
        return api.client.generic(
            "POST", f"{address}{more}", data=packed.getvalue(), content_type="application/octet-stream"
        )

    refused = answer()
    assert refused.status_code == 422
    assert [item["values"]["choice"] for item in refused.json()["diagnostics"]] == ["One", "Two"]
    assert answer("&main=Nobody").json()["diagnostics"][0]["code"] == "BT0727"
    made = answer("&main=Two")
    assert made.status_code == 201
    one = made.json()["id"]
    settings = api.client.get(f"/api/v1/projects/{one}/files/project.json")
    assert '"main_tree": "Two"' in str(settings.content)


def test_a_foreign_project_larger_than_an_owner_s_part_of_the_memory_is_imported(api, tmp_path, monkeypatch):
    """The request's own bytes, held for its upload, do not refuse the read of its answer."""
    them = readers.Readers(32 << 20, 256 << 20)
    monkeypatch.setattr(readers, "readers", lambda: them)
    packed = io.BytesIO()
    folder = write_wanderer(tmp_path / "robot", "top-to-bottom")
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for path in folder.rglob("*.*"):
            archive.write(path, path.relative_to(tmp_path))
        for n in range(5):
            archive.writestr(f"robot/assets/{n}.obj", f"# {n}\n" * (8_000_000 // 4))
        for n in range(2):  # they come with the answer
            archive.writestr(f"robot/assets/{n}.txt", "x" * 200_000)
    held = Reading("olga")
    token = reading.set(held)
    try:
        answer = api.client.generic(
            "POST",
            "/api/v1/projects/import?filename=p.zip&order=bottom-to-top",
            data=packed.getvalue(),
            content_type="application/octet-stream",
        )
    finally:
        reading.reset(token)
    assert answer.status_code == 201, answer.content
    assert sum(file["size"] for file in answer.json()["files"]) > 40_000_000
    assert them.total > 40_000_000
    held.close()
    assert them.total == 0


def test_an_import_asks_for_the_order_where_the_own_one_leaves_a_branch_out(api, tmp_path):
    packed = io.BytesIO()
    folder = write_wanderer(tmp_path / "robot", "top-to-bottom")
    with zipfile.ZipFile(packed, "w") as archive:
        for path in folder.rglob("*.*"):
            archive.write(path, path.relative_to(tmp_path))

    def answer(order):
        return api.client.generic(
            "POST",
            f"/api/v1/projects/import?filename=p.zip&order={order}",
            data=packed.getvalue(),
            content_type="application/octet-stream",
        )

    refused = answer("ask")
    assert refused.status_code == 422
    [found] = refused.json()["diagnostics"]
    assert (found["code"], found["values"]["other"]) == ("BT0811", "bottom-to-top")
    assert answer("sideways").json()["field"] == "order"
    assert set(ORDERS) == {"ask", *project.ORDERS}
    trees = [answer(order).json()["files"] for order in ("top-to-bottom", "bottom-to-top", "")]
    texts = [next(file["content"] for file in files if "trees/" in file["path"]) for files in trees]
    assert texts[0] == texts[2] != texts[1]
