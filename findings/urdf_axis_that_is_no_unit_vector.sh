#!/usr/bin/env bash
# Guess: readers of URDF treat <axis xyz="0 0 2"/> as a direction, so a joint at 0.5 moves by 0.5.
# Seen: of four readers two do. yourdfpy 0.0.60 normalises for turning joints but not for sliding ones
# (1.0 m instead of 0.5). ikpy 4.2.1 normalises neither: the sliding joint moves 1.0 m, and the "rotation" of
# the turning one is no rotation (its columns have the length 1.5 and its angle is 0.55 instead of 0.3).
# urchin 0.0.30 and mujoco 4.0.0 give 0.5 m and 0.3 rad. The file is valid: the length is not said to be one.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check \
  yourdfpy==0.0.60 ikpy==4.2.1 urchin==0.0.30 mujoco==4.0.0 numpy==2.4.6
cat > robot.urdf <<'URDF'
<robot name="r">
  <link name="a"/>
  <link name="b"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="c"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slide" type="prismatic">
    <parent link="a"/><child link="b"/><axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="turn" type="revolute">
    <parent link="b"/><child link="c"/><axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
env/bin/python -W ignore - <<'PYTHON'
from importlib.metadata import version

import ikpy.chain
import mujoco
import numpy as np
import urchin
import yourdfpy

SLIDE, TURN = 0.5, 0.3


def angle(matrix):
    return float(np.arctan2(matrix[1, 0], matrix[0, 0]))


found = {}
robot = yourdfpy.URDF.load("robot.urdf", load_meshes=False)
robot.update_cfg({"slide": SLIDE, "turn": TURN})
found["yourdfpy"] = robot.get_transform("b", "a")[2, 3], angle(robot.get_transform("c", "b"))
chain = ikpy.chain.Chain.from_urdf_file("robot.urdf", base_elements=["a"])
poses = chain.forward_kinematics([0, SLIDE, TURN], full_kinematics=True)
found["ikpy"] = poses[1][2, 3], angle(poses[2])
poses = urchin.URDF.load("robot.urdf", lazy_load_meshes=True).link_fk(
    cfg={"slide": SLIDE, "turn": TURN}, use_names=True
)
found["urchin"] = poses["b"][2, 3], angle(poses["c"])
model = mujoco.MjModel.from_xml_path("robot.urdf")
data = mujoco.MjData(model)
data.qpos[:] = [SLIDE, TURN]
mujoco.mj_forward(model, data)
found["mujoco"] = data.body("b").xpos[2], angle(data.body("c").xmat.reshape(3, 3))
for name, (height, turned) in found.items():
    print(f"{name} {version(name)}: slides {height:.3f} m, turns {turned:.3f} rad")
expected = {"yourdfpy": (1.0, 0.3), "ikpy": (1.0, 0.554), "urchin": (0.5, 0.3), "mujoco": (0.5, 0.3)}
for name, values in expected.items():
    assert np.allclose(found[name], values, atol=1e-3), (name, found[name])
PYTHON
