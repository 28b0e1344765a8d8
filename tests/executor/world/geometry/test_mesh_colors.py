"""Colours of mesh files: OBJ with its materials, glTF, binary STL, COLLADA; and those that cannot be read."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
import trimesh
from trimesh.visual.material import PBRMaterial

from executor.imports.meshes import stl
from executor.universes import parse_universe
from executor.world.geometry.companions import Companions
from executor.world.geometry.mesh import load_colored
from executor.world.geometry.mesh_colors import gltf_colors
from executor.world.physics.bullet import BulletWorld

if TYPE_CHECKING:
    from pathlib import Path

RED, BLUE = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)
OBJ = """mtllib {}
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1
usemtl red\nf 1 2 3
usemtl blue\nf 1 2 4\nf 1 3 4
"""
MTL = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nmap_Kd missing.png\n"
DAE_PART = """<geometry id="{0}" name="{0}"><mesh><source id="{0}p">
<float_array id="{0}a" count="9">0 0 0 1 0 0
0 1 0</float_array><technique_common>
<accessor source="#{0}a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="{0}v"><input semantic="POSITION" source="#{0}p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#{0}v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry>"""
DAE = f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_effects><effect id="e"><profile_COMMON><technique sid="t">
<lambert><diffuse><color>1 0 0 1</color></diffuse>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="r"><instance_effect url="#e"/></material></library_materials>
<library_geometries>{DAE_PART.format("g")}</library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g">
<bind_material><technique_common>
<instance_material symbol="m" target="#r"/></technique_common></bind_material></instance_geometry></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def obj(folder: Path, library: str = "a.mtl") -> Path:
    (folder / "a.obj").write_text(OBJ.format(library))
    (folder / "a.mtl").write_text(MTL)
    return folder / "a.obj"


def glb(folder: Path) -> Path:
    first, second = trimesh.creation.box(), trimesh.creation.box()
    first.visual = trimesh.visual.TextureVisuals(material=PBRMaterial(baseColorFactor=[1.0, 0.0, 0.0, 1.0]))
    second.visual = trimesh.visual.TextureVisuals(material=PBRMaterial(baseColorFactor=[0.0, 0.0, 1.0, 1.0]))
    (folder / "a.glb").write_bytes(trimesh.Scene([first, second]).export(file_type="glb"))
    return folder / "a.glb"


def stl_file(folder: Path, header: bytes, marks: list[int]) -> Path:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    data = bytearray(stl(points, np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3]])))
    data[: len(header)] = header
    for number, mark in enumerate(marks):
        data[84 + 50 * number + 48 : 84 + 50 * number + 50] = mark.to_bytes(2, "little")
    (folder / "a.stl").write_bytes(data)
    return folder / "a.stl"


def dae(folder: Path) -> Path:
    (folder / "a.dae").write_text(DAE)
    return folder / "a.dae"


def counts(path: Path) -> dict[object, int]:
    return {color: len(mesh.indices) // 12 for color, mesh in load_colored(path).parts}


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (obj, {RED: 1, BLUE: 2}),
        (glb, {RED: 12, BLUE: 12}),
        (dae, {RED: 1}),
        (
            lambda folder: stl_file(folder, b"", [0x8000 | 31 << 10, 0x8000 | 31, 0]),
            {RED: 1, BLUE: 1, None: 1},
        ),
        (
            lambda folder: stl_file(folder, b"COLOR=\1\1\1\1", [31, 31 << 10, 0x8000]),
            {RED: 1, BLUE: 1, None: 1},
        ),
        (lambda folder: stl_file(folder, b"", [0, 0, 31]), {}),
    ],
    ids=["obj", "glb", "dae", "VisCAM", "Materialise", "marks of something else"],
)
def test_triangles_have_the_colours_of_their_file(tmp_path, make, expected):
    assert counts(make(tmp_path)) == expected


@pytest.mark.parametrize("library", ["missing.mtl", "../outside.mtl", "a.obj"])
def test_materials_that_are_not_beside_the_file_cost_the_colours_alone(tmp_path, library):
    (tmp_path / "outside.mtl").write_text(MTL)
    folder = tmp_path / "in"
    folder.mkdir()
    found = load_colored(obj(folder, library))
    assert found.parts == ()
    assert found.note == "the materials of a.obj cannot be read"
    assert len(found.whole.indices) == 3 * 12


def test_colours_of_gltf_are_linear_in_the_file(tmp_path):
    data = glb(tmp_path).read_bytes().replace(b"[0.0,0.0,1.0,1.0]", b"[0.0,0.0,0.5,1.0]")
    found = gltf_colors(data, Companions(tmp_path / "a.glb"))
    assert found[1] == (
        0.0,
        0.0,
        pytest.approx(0.735, abs=1e-3),
        1.0,
    )


def test_the_scene_of_a_universe_has_them(tmp_path):
    (tmp_path / "assets").mkdir()
    obj(tmp_path / "assets")
    text = (
        "format: bt-studio/universe\nversion: 1\nname: U\nmodels:\n"
        "  - {id: own, shape: mesh, file: assets/a.obj, pose: [0, 0, 0, 0, 0, 0]}\n"
        "  - {id: chosen, shape: mesh, file: assets/a.obj, pose: [3, 0, 0, 0, 0, 0], color: '#00ff00'}\n"
    )
    world = BulletWorld(parse_universe(text), assets=tmp_path)
    try:
        shapes = {each.body: each.shapes for each in world.scene.objects}
        assert {tuple(shape.color) for shape in shapes["own"]} == {RED, BLUE}
        assert [tuple(shape.color) for shape in shapes["chosen"]] == [(0.0, 1.0, 0.0, 1.0)]
        assert set(world.scene.meshes) == {
            shape.mesh for own in shapes.values() for shape in own if shape.mesh
        }
    finally:
        world.close()
