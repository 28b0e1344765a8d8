"""COLLADA: the unit is applied, the axes stay, and malformed materials cost nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from executor.world.geometry.collada import load_collada, unit_of
from executor.world.geometry.mesh import MeshError, load_mesh

if TYPE_CHECKING:
    from pathlib import Path

PLATE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>{unit}<up_axis>Y_UP</up_axis></asset>
{materials}
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 10 0 0 0 0 20</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="paint">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n">
<instance_geometry url="#g">{bound}</instance_geometry>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
INCH = '<unit name="inch" meter="0.0254"/>'
BOUND = (
    "<bind_material><technique_common>"
    '<instance_material symbol="paint" target="#paint"/></technique_common></bind_material>'
)
MALFORMED = """<library_materials>
<material id="paint"><instance_effect url="#e"/></material></library_materials>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong>
<diffuse><color>red</color></diffuse><shininess><float>very</float></shininess>
<transparent><color>1</color></transparent></phong></technique></profile_COMMON></effect></library_effects>"""


def written(folder: Path, *, unit: str = INCH, materials: str = "", bound: str = "") -> Path:
    path = folder / "plate.dae"
    path.write_text(PLATE.format(unit=unit, materials=materials, bound=bound))
    return path


def extent(path: Path) -> list[float]:
    points = np.frombuffer(load_mesh(path).positions, "<f4").reshape(-1, 3)
    found: list[float] = np.ptp(points, axis=0).tolist()
    return found


@pytest.mark.parametrize(
    ("unit", "scale"),
    [(INCH, 0.0254), ("", 1.0), ('<unit meter="0"/>', 1.0), ('<unit meter="x"/>', 1.0), ("<unit/>", 1.0)],
)
def test_the_unit_is_applied_and_the_axes_stay(tmp_path: Path, unit: str, scale: float) -> None:
    assert extent(written(tmp_path, unit=unit)) == pytest.approx([10 * scale, 0, 20 * scale])


@pytest.mark.parametrize("materials", ["", MALFORMED])
def test_materials_that_are_malformed_or_missing_do_not_matter(tmp_path: Path, materials: str) -> None:
    path = written(tmp_path, materials=materials, bound=BOUND)
    assert extent(path) == pytest.approx([0.254, 0, 0.508])


def test_a_file_that_is_no_collada_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "plate.dae"
    path.write_text("<COLLADA")
    assert unit_of(path.read_bytes()) == 1.0
    with pytest.raises(MeshError, match=r"plate.dae cannot be read"):
        load_mesh(path)
    with pytest.raises(Exception, match=r"."):
        load_collada(b"")
