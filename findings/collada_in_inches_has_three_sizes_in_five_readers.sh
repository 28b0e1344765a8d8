#!/usr/bin/env bash
# Guess: readers of COLLADA return metres, or all return the file's own unit; and all turn it to the same axis.
# Seen with trimesh 5.2.0, pycollada 0.9.3, coal 3.0.3, assimp-py 1.1.0 and pybullet 3.2.7: a block of 1 x 1 x 2
# inches, up_axis Z, is
#   1 x 1 x 2                  in trimesh (units: the text "0.0254 * meters"), pycollada, and coal, which reads by Assimp
#   0.0254 x 0.0508 x 0.0254   in Assimp itself with PreTransformVertices: metres, turned from Z up to Y up
#   0.0254 x 0.0254 x 0.0508   in PyBullet, metres (and 4 mm more in each direction in its box of bounds)
# With up_axis Y, Assimp turns nothing and PyBullet turns nothing either, so for those files they agree.
# So a URDF with a mesh in inches collides at 39 times its size in what rests on coal, and rightly in PyBullet.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check \
  trimesh==5.2.0 pycollada==0.9.3 scipy coal==3.0.3 assimp-py==1.1.0 pybullet==3.2.7 numpy==2.4.6
env/bin/python - <<'PYTHON'
import itertools
from pathlib import Path

import assimp_py
import coal
import collada
import numpy as np
import pybullet
import trimesh

INCH = 0.0254
POINTS = list(itertools.product((0, 1), (0, 1), (0, 2)))
FACES = (0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5)
URDF = """<robot name="block"><link name="block"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><mesh filename="block.dae"/></geometry></collision></link></robot>"""


def document(up):
    numbers = " ".join(str(each) for point in POINTS for each in point)
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified>
<unit name="inch" meter="{INCH}"/><up_axis>{up}</up_axis></asset>
<library_geometries><geometry id="block"><mesh>
<source id="points"><float_array id="numbers" count="24">{numbers}</float_array><technique_common>
<accessor source="#numbers" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#points"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#corners" offset="0"/>
<p>{" ".join(map(str, FACES))}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="node"><instance_geometry url="#block"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""


def extent(points):
    points = np.asarray(points, dtype=float).reshape(-1, 3)
    return points.max(axis=0) - points.min(axis=0)


def by_pycollada():
    scene = collada.Collada("block.dae").scene
    return extent(np.concatenate([part.vertex for shape in scene.objects("geometry") for part in shape.primitives()]))


def by_coal():
    shape = coal.MeshLoader().load("block.dae")
    shape.computeLocalAABB()
    return np.array([shape.aabb_local.width(), shape.aabb_local.height(), shape.aabb_local.depth()])


def by_assimp():
    steps = assimp_py.Process_Triangulate | assimp_py.Process_PreTransformVertices
    scene = assimp_py.import_file("block.dae", steps)
    return extent(np.array(scene.meshes[0].vertices))


def by_pybullet():
    pybullet.connect(pybullet.DIRECT)
    least, most = pybullet.getAABB(pybullet.loadURDF("block.urdf"))
    pybullet.disconnect()
    return np.subtract(most, least)


Path("block.urdf").write_text(URDF)
seen = {}
for up in ("Z_UP", "Y_UP"):
    Path("block.dae").write_text(document(up))
    loaded = trimesh.load("block.dae")
    assert "0.0254" in str(loaded.units), loaded.units
    seen[up] = {
        "trimesh": loaded.extents,
        "pycollada": by_pycollada(),
        "coal": by_coal(),
        "assimp": by_assimp(),
        "pybullet": by_pybullet(),
    }
    for name, size in seen[up].items():
        print(up, name, np.round(size, 4))
for up, sizes in seen.items():
    for name in ("trimesh", "pycollada", "coal"):
        assert np.allclose(sizes[name], (1, 1, 2)), (up, name)
    assert np.allclose(sizes["pybullet"], np.multiply((1, 1, 2), INCH) + 0.004, atol=1e-4), up
assert np.allclose(seen["Z_UP"]["assimp"], np.multiply((1, 2, 1), INCH))
assert np.allclose(seen["Y_UP"]["assimp"], np.multiply((1, 1, 2), INCH))
PYTHON
