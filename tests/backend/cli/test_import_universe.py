"""`bt-studio import-universe`."""

from __future__ import annotations

import json

import pytest

from backend.cli.import_universe import import_universe
from backend.cli.shared import translation
from backend.cli.shared.errors import CliError
from executor.universes import parse_universe
from tests.backend.disks import SmallDisk, small_disk
from tests.executor.uploads.zips import MESH, WORLD, triangles, zipped

SDF = """\
<sdf version="1.9"><world name="yard"><physics/>
<model name="crate"><static>1</static><link name="link"><collision name="c"/>
<visual name="visual"><geometry><box><size>1 1 1</size></box></geometry></visual></link></model></world></sdf>
"""


def test_a_world_becomes_a_universe_and_the_rest_is_reported(tmp_path, capsys):
    source = tmp_path / "yard.sdf"
    source.write_text(SDF)
    import_universe(source)
    said = capsys.readouterr().out
    assert "1 thing\n" in said
    assert "yard.sdf:1: <physics> has no counterpart here" in said
    assert [model.id for model in parse_universe((tmp_path / "yard.yaml").read_text()).models] == ["crate"]
    import_universe(source, output=tmp_path / "other.yaml", as_json=True)
    assert json.loads(capsys.readouterr().out)["left_out"][0]["line"] == 1


def test_what_cannot_be_done_is_said(tmp_path):
    source = tmp_path / "yard.sdf"
    with pytest.raises(CliError, match="No such file"):
        import_universe(source)
    source.write_text("<sdf><world>")
    with pytest.raises(CliError, match=r"yard\.sdf:1:"):
        import_universe(source)
    (tmp_path / "yard.yaml").write_text("mine")
    with pytest.raises(CliError, match="exists already"):
        import_universe(source)
    assert (tmp_path / "yard.yaml").read_text() == "mine"


def test_models_around_the_world_are_found_and_their_meshes_copied(tmp_path, capsys):
    corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0"
    mesh = f"solid a\nfacet normal 0 0 1\nouter loop\n{corners}\nendloop\nendfacet\nendsolid"
    crate = tmp_path / "shop" / "models" / "crate"
    crate.mkdir(parents=True)
    (crate / "model.config").write_text("<model><name>crate</name><sdf>model.sdf</sdf></model>")
    (crate / "a.stl").write_text(mesh)
    (crate / "model.sdf").write_text(
        "<sdf version='1.9'><model name='crate'><static>1</static><link name='l'><visual name='v'><geometry>"
        "<mesh><uri>model://crate/a.stl</uri></mesh></geometry></visual></link></model></sdf>"
    )
    source = tmp_path / "shop" / "worlds" / "yard.sdf"
    source.parent.mkdir()
    source.write_text(
        "<sdf version='1.9'><world name='w'><include><uri>model://crate</uri></include></world></sdf>"
    )
    target = tmp_path / "project" / "universes" / "yard.yaml"
    import_universe(source, output=target)
    assert "1 thing\n" in capsys.readouterr().out
    assert (tmp_path / "project" / "assets" / "yard" / "meshes" / "a.stl").read_text() == mesh
    target.unlink()
    with pytest.raises(CliError, match="exists already"):
        import_universe(source, output=target)
    assert not target.exists()


def test_a_world_with_nothing_to_import_fails(tmp_path):
    source = tmp_path / "empty.sdf"
    source.write_text("<sdf version='1.9'><world name='w'><physics/></world></sdf>")
    with pytest.raises(CliError, match="nothing of this world was imported"):
        import_universe(source)
    assert not (tmp_path / "empty.yaml").exists()


def test_a_map_becomes_walls(tmp_path, capsys):
    (tmp_path / "flat.pgm").write_bytes(b"P5 2 1 255\n\x00\xfe")
    (tmp_path / "flat.yaml").write_text("image: flat.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n")
    import_universe(tmp_path / "flat.yaml")
    assert "flat.universe.yaml: 1 thing\n" in capsys.readouterr().out
    assert parse_universe((tmp_path / "flat.universe.yaml").read_text()).models[0].size == (0.05, 0.05, 1.0)


def test_a_zip_is_imported_as_its_folder(tmp_path, capsys):
    source = tmp_path / "shop.zip"
    source.write_bytes(zipped(WORLD))
    import_universe(source, output=tmp_path / "project" / "universes" / "yard.yaml")
    assert "yard.sdf:1: <physics> has no counterpart here" in capsys.readouterr().out
    assert (tmp_path / "project" / "assets" / "yard" / "meshes" / "a.stl").read_bytes() == MESH


def test_a_folder_for_temporary_files_that_is_full_is_said(tmp_path):
    source = tmp_path / "shop.zip"
    source.write_bytes(zipped(WORLD | {"shop/models/crate/a.stl": triangles(30_000)}))
    with (
        SmallDisk(tmp_path, 1, mounted=False).limited(),
        pytest.raises(CliError, match=r"shop\.zip:1:1: File too large"),
    ):
        import_universe(source, output=tmp_path / "project" / "yard.yaml")
    assert not (tmp_path / "project").exists()


def test_on_a_full_disk_nothing_of_a_universe_is_left(tmp_path, monkeypatch):
    source = tmp_path / "shop.zip"
    source.write_bytes(zipped(WORLD | {"shop/models/crate/a.stl": triangles(30_000)}))
    with small_disk(tmp_path / "disk", 1) as disk:
        monkeypatch.setattr(translation, "write_files", disk.limited_at(translation.write_files))
        target = tmp_path / "disk" / "project" / "universes" / "yard.yaml"
        with pytest.raises(CliError, match=r"a\.stl:1:1: it cannot be written: (No space|File too large)"):
            import_universe(source, output=target)
        assert [*(tmp_path / "disk").iterdir()] == []


def test_of_two_models_of_one_name_the_nearest_is_said_and_a_missing_one_has_what_to_do(tmp_path, capsys):
    other = {path.replace("crate/", "other/"): data for path, data in WORLD.items() if "models" in path}
    missing = WORLD["shop/worlds/yard.sdf"].replace(
        b"</world>", b"\n<include><uri>model://nowhere</uri></include></world>"
    )
    for path, data in (WORLD | other | {"shop/worlds/yard.sdf": missing}).items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(data)
    import_universe(tmp_path / "shop" / "worlds" / "yard.sdf", output=tmp_path / "out" / "yard.yaml")
    said = capsys.readouterr().out
    assert "'crate' is the name of 2 folders: models/crate of the folder around it is the nearest" in said
    [line] = [each for each in said.splitlines() if "nowhere" in each]
    assert "yard.sdf:3: <include> of model://nowhere" in line
    assert "were searched; copy the folder whose package.xml or model.config has that name into" in line
    assert "_PATH" not in line
