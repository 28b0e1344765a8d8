"""The catalogue that the editor reads."""

from __future__ import annotations

import json

import pytest

from backend.catalog import views
from backend.catalog.queries import NODES, OUTSIDE
from backend.config.environment import REPOSITORY


def test_the_nodes_are_those_of_the_one_table(api):
    assert api.get("catalog/nodes") == json.loads(NODES.read_text())


def test_installed_interfaces_are_listed_and_described(api):
    names = {each["name"]: each["kind"] for each in api.get("catalog/interfaces")["items"]}
    assert names["nav2_msgs/action/NavigateToPose"] == "action"
    ports = api.get("catalog/interfaces/nav2_msgs/action/NavigateToPose")["ports"]
    assert {
        "port": "goal__pose__pose__position__x",
        "direction": "input",
        "type": "double",
        "ros": "double",
    } in ports
    assert api.client.get("/api/v1/catalog/interfaces/no_msgs/msg/Nothing").status_code == 404


def test_universes_and_robots_have_an_id_and_a_name(api):
    universes = {entry["id"]: entry for entry in api.get("catalog/universes")["items"]}
    assert {"walled_room", "person_in_green"} <= set(universes)
    assert universes["walled_room"]["name"] == "Walled room"
    assert "turtle2" in {entry["id"] for entry in api.get("catalog/robots")["items"]}


@pytest.mark.parametrize("kind", ["universe", "robot"])
def test_each_universe_and_robot_has_its_title_in_spanish_too(api, kind):
    locales = REPOSITORY / "frontend" / "src" / "i18n" / "locales"
    english, spanish = (
        json.loads((locales / name / "worlds.json").read_text())[kind] for name in ("en", "es")
    )
    entries = {entry["id"]: entry for entry in api.get(f"catalog/{kind}s")["items"]}
    assert set(english) == set(spanish) == set(entries)
    for name, entry in entries.items():
        assert english[name] == {"name": entry["name"], "description": entry["description"]}
        assert spanish[name]["description"] not in ("", entry["description"])


@pytest.mark.parametrize("kind", ["universes", "robots"])
def test_each_universe_and_robot_has_a_picture(api, kind):
    for entry in api.get(f"catalog/{kind}")["items"]:
        if entry["id"] == OUTSIDE:
            assert entry["preview"] == ""
            continue
        answer = api.client.get(entry["preview"])
        assert answer.status_code == 200
        assert answer["Content-Type"] == "image/webp"
        assert answer.content[:4] == b"RIFF"
    assert api.client.get(f"/api/v1/catalog/{kind}/ghost/preview").status_code == 404
    assert api.client.get(f"/api/v1/catalog/{kind}/..%2Fempty/preview").status_code == 404


def test_a_universe_and_a_robot_can_be_read_as_they_are_written(api):
    assert api.client.get("/api/v1/catalog/universes/house/text").content.startswith(
        b"format: bt-studio/universe"
    )
    for robot in api.get("catalog/robots")["items"]:
        assert b"<robot " in api.client.get(f"/api/v1/catalog/robots/{robot['id']}/urdf").content
        config = api.client.get(f"/api/v1/catalog/robots/{robot['id']}/config").content
        assert config.startswith(b"format: bt-studio/robot")
    assert api.client.get("/api/v1/catalog/universes/ghost/text").status_code == 404
    assert api.client.get("/api/v1/catalog/robots/..%2Fturtle2/urdf").status_code == 404
    assert api.client.get("/api/v1/catalog/robots/ghost/config").status_code == 404


def test_templates_are_the_empty_project_and_the_examples(api):
    items = api.get("catalog/templates")["items"]
    assert items[0]["id"] == "empty"
    assert {"laser_bump_and_go", "visual_follow_person"} <= {item["id"] for item in items}
    assert [item["id"] for item in items if not item["root_diagram"]["nodes"]] == ["empty"]


def test_a_folder_without_examples_leaves_the_empty_project(api, settings_of, tmp_path):
    settings_of(templates_dir=tmp_path / "none")
    assert [item["id"] for item in api.get("catalog/templates")["items"]] == ["empty"]


def test_every_view_of_the_catalogue_only_reads():
    found = [
        view for view in vars(views).values() if isinstance(view, type) and view.__module__ == views.__name__
    ]
    assert len(found) == 7
    writes = {"post", "put", "patch", "delete", "create", "update", "partial_update", "destroy"}
    assert not [view for view in found if writes & set(vars(view))]
