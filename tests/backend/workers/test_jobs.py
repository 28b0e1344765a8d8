"""The jobs of a worker."""

from __future__ import annotations

import base64
import io
import json
import zipfile

from backend.workers.jobs import JOBS

TREE = json.dumps({"id": "MainTree", "root": "n1", "nodes": {"n1": {"type": "AlwaysSuccess"}}})
FILES = {"project.json": b'{"name": "P"}', "trees/MainTree.json": TREE.encode()}
BROKEN = {**FILES, "trees/MainTree.json": TREE.replace("AlwaysSuccess", "Nope").encode()}


def test_a_report_names_problems_and_actions() -> None:
    assert JOBS["report"](files=FILES) == {"diagnostics": [], "actions": [], "ros_distro": "jazzy"}
    assert JOBS["report"](files=BROKEN)["diagnostics"]


def test_what_the_translator_refuses_is_an_answer() -> None:
    refused = JOBS["xml"](files=BROKEN, self_contained=False)["refused"]
    assert refused[0]["code"].startswith("BT")
    assert "<AlwaysSuccess" in JOBS["xml"](files=FILES, self_contained=False)["text"]


def test_an_app_is_a_zip_with_its_universe() -> None:
    files = {**FILES, "universes/yard.yaml": b"name: yard\n", "assets/a.png": b"x"}
    made = JOBS["app"](files=files, universe="yard", built_in=None, revision=3)
    assert made["universe"]["document"] == "name: yard\n"
    with zipfile.ZipFile(io.BytesIO(base64.b64decode(made["universe"]["assets_zip_base64"]))) as assets:
        assert "assets/a.png" in assets.namelist()
    assert JOBS["app"](files=FILES, universe="empty", built_in=None, revision=3)["universe"] == "empty"


def test_an_import_proposes_a_universe_and_says_by_which_topics() -> None:
    tree = b'<root BTCPP_format="4"><BehaviorTree ID="Main"><Look/></BehaviorTree></root>'
    source = b'node.create_subscription(Image, "/eye", f, 10)'
    opened = JOBS["opened"]
    seen = opened(files={"t.xml": tree, "actions/Look.py": source}, name="t", repair=False)
    assert seen["proposal"] == {"universe": "person_in_green", "topics": "/eye"}
    assert json.loads(seen["files"]["project.json"])["universe"] == "person_in_green"
    assert opened(files={"t.xml": tree}, name="t", repair=False)["proposal"] is None


def test_a_text_that_is_half_typed_has_findings_and_no_diagram() -> None:
    written = JOBS["write_tree"](diagram=TREE, base="", ids=[])
    assert JOBS["read_tree"](xml=written["xml"], diagram=TREE)["diagram"]
    half = JOBS["read_tree"](xml="<root", diagram=TREE)
    assert half["diagram"] is None
    assert half["diagnostics"]


def test_a_package_of_cpp_its_models_and_a_schema() -> None:
    made = JOBS["cpp_package"](files=FILES, name=None)
    assert made["name"].endswith("_cpp")
    with zipfile.ZipFile(io.BytesIO(made["zip"])) as package:
        assert f"{made['name']}/src/register_nodes.cpp" in package.namelist()
    assert "<TreeNodesModel>" in JOBS["models"](files=FILES)["text"]
    assert "<xs:schema" in JOBS["xsd"](files=FILES)["text"]
    assert JOBS["cpp_package"](files=BROKEN, name=None)["refused"]
