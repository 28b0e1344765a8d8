"""`bt-studio import-robot`."""

from __future__ import annotations

import json

import pytest

from backend.cli.import_robot import import_robot
from backend.cli.shared import translation
from backend.cli.shared.errors import CliError
from executor.robots import load_robot
from tests.backend.disks import SmallDisk, small_disk
from tests.executor.expansion.probes import probes, was_refused
from tests.executor.robots.importing.carts import BODY, CASTOR, PAIR, robot
from tests.executor.uploads.zips import MESH, PACKAGE, triangles, zipped

MACROS = robot(BODY, PAIR, CASTOR.format(x=0.1), '<link name="$(arg top)"/>', "<extra/>").replace(
    'name="cart"', 'name="cart" xmlns:xacro="http://x"', 1
)
TOP = '<joint name="t" type="fixed"><parent link="base_link"/><child link="$(arg top)"/></joint></robot>'


@pytest.fixture
def source(tmp_path):
    path = tmp_path / "cart.urdf.xacro"
    path.write_text(MACROS.replace("</robot>", TOP))
    return path


def test_a_robot_is_imported_and_what_was_done_is_reported(source, tmp_path, capsys):
    project = tmp_path / "project"
    import_robot(source, into=project, arguments=["top:=lid"])
    said = capsys.readouterr().out
    for part in ("robots/cart: cart", "Taken:", "Assumed:", "Left out:", "Test drive: 1.00 m commanded"):
        assert part in said
    assert "lid" in load_robot("cart", project).urdf.links
    with pytest.raises(CliError, match="exists already"):
        import_robot(source, into=project, arguments=["top:=lid"])
    import_robot(source, into=project, name="two", arguments=["top:=lid"], drive=False, as_json=True)
    answer = json.loads(capsys.readouterr().out)
    assert answer["test_drive"] is None
    assert answer["left_out"] == ["cart.urdf.xacro:17: <extra> is not read"]
    assert sorted(path.name for path in (project / "robots").iterdir()) == ["cart", "two"]


def test_what_cannot_be_done_is_said_and_nothing_is_written(source, tmp_path):
    project = tmp_path / "project"
    for given, message in (
        ({"arguments": []}, "there is no argument top"),
        ({"arguments": ["top=lid"]}, "write name:=value"),
        ({"name": "../out", "arguments": ["top:=lid"]}, "is no name of a folder"),
    ):
        with pytest.raises(CliError, match=message):
            import_robot(source, into=project, **given)
    with pytest.raises(CliError, match="No such file"):
        import_robot(tmp_path / "no.urdf", into=project)
    (tmp_path / "empty").mkdir()
    with pytest.raises(CliError, match="there is no URDF"):
        import_robot(tmp_path / "empty", into=project)
    still = tmp_path / "still.urdf"
    still.write_text(robot(BODY))
    with pytest.raises(CliError, match=r"still\.urdf:1:1: the robot cannot be imported: it has no wheel"):
        import_robot(still, into=project)
    assert not project.exists()


def test_a_zip_is_imported_as_its_folder_and_no_macro_reads_outside(tmp_path, capsys):
    source = tmp_path / "ws.zip"
    source.write_bytes(zipped(PACKAGE, {"ws/out.stl": "/etc/passwd"}))
    import_robot(source, into=tmp_path / "project", drive=False)
    assert "ws/out.stl: links and devices are not followed" in capsys.readouterr().out
    assert (tmp_path / "project" / "robots" / "cart" / "meshes" / "lid.stl").read_bytes() == MESH
    with pytest.raises(CliError, match="there is no file none"):
        import_robot(source, into=tmp_path / "project", main="none.urdf")
    source.write_bytes(b"PK")
    with pytest.raises(CliError, match=r"ws\.zip: This is not a zip"):
        import_robot(source, into=tmp_path / "project")
    (tmp_path / "secret.yaml").write_text("word: hidden")
    for probe in probes(tmp_path / "secret.yaml"):
        source.write_bytes(zipped({"r/r.xacro": probe.encode()}))
        with pytest.raises(CliError, match=r"r\.xacro:2:1: BTR002 xacro: ") as error:
            import_robot(source, into=tmp_path / "project", name="r")
        assert was_refused(str(error.value))


def test_a_folder_for_temporary_files_that_is_full_is_said(tmp_path):
    source = tmp_path / "ws.zip"
    source.write_bytes(zipped(PACKAGE | {"ws/cart/meshes/lid.stl": triangles(30_000)}))
    with (
        SmallDisk(tmp_path, 1, mounted=False).limited(),
        pytest.raises(CliError, match=r"ws\.zip:1:1: File too large"),
    ):
        import_robot(source, into=tmp_path / "project", drive=False)
    assert not (tmp_path / "project").exists()


def test_on_a_full_disk_nothing_of_a_robot_is_left(tmp_path, monkeypatch):
    source = tmp_path / "ws.zip"
    source.write_bytes(zipped(PACKAGE | {"ws/cart/meshes/lid.stl": triangles(30_000)}))
    with small_disk(tmp_path / "disk", 1) as disk:
        monkeypatch.setattr(translation, "write_files", disk.limited_at(translation.write_files))
        with pytest.raises(CliError, match=r"lid\.stl:1:1: it cannot be written: (No space|File too large)"):
            import_robot(source, into=tmp_path / "disk" / "project", drive=False)
        assert [*(tmp_path / "disk").iterdir()] == []
