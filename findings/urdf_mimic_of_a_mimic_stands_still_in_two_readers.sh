#!/usr/bin/env bash
# Guess: a joint that mimics a joint that mimics a third one (a gripper's finger tip) moves in every reader.
# Seen: in one of four. With j2 = 2 j1 + 0.1 and j3 = 3 j2, j1 at 0.2 asks for j3 at 1.5.
# yourdfpy 0.0.60 leaves j3 at 0 and warns that j2 "is not actuated"; urchin 0.0.30 leaves it at 0 without a
# word; pinocchio (pin 4.1.0) with mimic=True refuses the whole robot, and without it has three free joints.
# mujoco 4.0.0 makes two equality constraints, 0.1 + 2 j1 and 3 j2: there j3 follows.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check \
  yourdfpy==0.0.60 urchin==0.0.30 mujoco==4.0.0 pin==4.1.0 numpy==2.4.6
env/bin/python -W ignore - <<'PYTHON'
from importlib.metadata import version
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import urchin
import yourdfpy

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
LIMIT = '<axis xyz="0 0 1"/><limit lower="-9" upper="9" effort="1" velocity="1"/>'


def joint(name, parent, child, mimic=""):
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="revolute">{ends}{LIMIT}{mimic}</joint>'


links = "".join(f'<link name="{name}">{INERTIAL if name != "a" else ""}</link>' for name in "abcd")
text = f"""<robot name="r">{links}
{joint("j1", "a", "b")}
{joint("j2", "b", "c", '<mimic joint="j1" multiplier="2" offset="0.1"/>')}
{joint("j3", "c", "d", '<mimic joint="j2" multiplier="3"/>')}
</robot>"""
Path("robot.urdf").write_text(text)


def angle(matrix):
    return float(np.arctan2(matrix[1, 0], matrix[0, 0]))


found = {}
robot = yourdfpy.URDF.load("robot.urdf", load_meshes=False)
robot.update_cfg({"j1": 0.2})
found["yourdfpy"] = [angle(robot.get_transform(child, parent)) for parent, child in ("ab", "bc", "cd")]
poses = urchin.URDF.load("robot.urdf", lazy_load_meshes=True).link_fk(cfg={"j1": 0.2}, use_names=True)
found["urchin"] = [angle(np.linalg.inv(poses[p]) @ poses[c]) for p, c in ("ab", "bc", "cd")]
for name, angles in found.items():
    print(f"{name} {version(name)}: j1, j2, j3 at {np.round(angles, 3)}")
    assert np.allclose(angles, [0.2, 0.5, 0.0], atol=1e-6)
model = mujoco.MjModel.from_xml_path("robot.urdf")
print(f"mujoco {version('mujoco')}: {model.neq} equalities, {np.round(model.eq_data[:, :2], 3).tolist()}")
assert np.allclose(model.eq_data[:, :2], [[0.1, 2.0], [0.0, 3.0]])
free = pinocchio.buildModelFromUrdf("robot.urdf")
print(f"pin {version('pin')}: {free.nq} free joints without mimic")
assert free.nq == 3
try:
    pinocchio.buildModelFromUrdf("robot.urdf", mimic=True)
except ValueError as error:
    print("pin with mimic=True:", " ".join(str(error).split())[-160:])
else:
    raise AssertionError("pin reads a mimic of a mimic")
PYTHON
