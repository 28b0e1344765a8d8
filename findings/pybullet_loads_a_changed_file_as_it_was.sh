#!/usr/bin/env bash
# Guess: loadURDF and createCollisionShape read the file that is there when they are called.
# Seen with pybullet 3.2.7: a connection keeps what it has read by name. A URDF or OBJ that was written again is loaded
# as it was at first, also after resetSimulation; a new connection, or enableFileCaching=0, reads the new one. A loop
# that writes a variant of a robot, loads it and measures (a search for masses, for example) measures the first one.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check pybullet==3.2.7 numpy==2.4.6
env/bin/python - <<'PYTHON'
from pathlib import Path

import pybullet

URDF = """<robot name="block"><link name="block"><inertial><mass value="{mass}"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""
FACES = "f 1 2 3\nf 2 3 4\nf 5 6 7\nf 6 7 8\nf 1 2 5\nf 3 4 7\n"


def mass_of(mass):
    """Writes a robot of this mass, loads it, and returns the mass it has."""
    Path("block.urdf").write_text(URDF.format(mass=mass))
    pybullet.resetSimulation()
    return pybullet.getDynamicsInfo(pybullet.loadURDF("block.urdf"), -1)[0]


def height_of(height):
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, height)]
    Path("block.obj").write_text("".join("v {} {} {}\n".format(*each) for each in corners) + FACES)
    pybullet.resetSimulation()
    shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, fileName="block.obj")
    return round(pybullet.getAABB(pybullet.createMultiBody(1, shape))[1][2], 2)


pybullet.connect(pybullet.DIRECT)
masses, heights = [mass_of(each) for each in (1, 2, 3)], [height_of(each) for each in (1, 2, 3)]
print("masses 1, 2, 3 are", masses, "and heights", heights)
assert masses == [1, 1, 1]
assert heights == [1, 1, 1]
pybullet.disconnect()
pybullet.connect(pybullet.DIRECT)
assert mass_of(4) == 4
pybullet.setPhysicsEngineParameter(enableFileCaching=0)
masses, heights = [mass_of(each) for each in (1, 2, 3)], [height_of(each) for each in (1, 2, 3)]
print("without caching", masses, heights)
assert masses == [1, 2, 3]
assert heights == [1, 2, 3]
PYTHON
