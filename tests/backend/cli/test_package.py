"""`bt-studio package`."""

from __future__ import annotations

import zipfile

from backend.cli.package import package

TREE = '<root BTCPP_format="4"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>'


def test_a_tree_becomes_a_package_or_an_app(tmp_path):
    (tmp_path / "t.xml").write_text(TREE)
    package(str(tmp_path / "t.xml"), output=tmp_path / "out.zip", name="my_robot")
    with zipfile.ZipFile(tmp_path / "out.zip") as made:
        assert "my_robot/package.xml" in made.namelist()
    package(str(tmp_path / "t.xml"), output=tmp_path / "app.zip", dockerized=True)
    with zipfile.ZipFile(tmp_path / "app.zip") as made:
        assert made.testzip() is None
        assert "my_robot/package.xml" not in made.namelist()
