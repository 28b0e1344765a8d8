#!/usr/bin/env bash
# Guess: <limit effort="0" velocity="0"/>, which exporters of CAD programs write for "not stated", means one thing.
# Seen with mujoco 4.0.0, pin 4.1.0 and pybullet 3.2.7: MuJoCo reads it as a joint without a limit of force, beside
# one of 7 Nm that it does limit; Pinocchio keeps 0, so a controller that clips by its model commands nothing;
# PyBullet reports 0 and drives the joint all the same, since its motor asks for a force of its own.
# None of the three says a word.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check mujoco==4.0.0 pin==4.1.0 pybullet==3.2.7
env/bin/python - <<'PYTHON'
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import pybullet

INERTIAL = '<inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>'
JOINT = """
<joint name="{name}" type="revolute"><parent link="base"/><child link="{name}_arm"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" effort="{effort}" velocity="{effort}"/></joint>"""
links = "".join(f'<link name="{name}">{INERTIAL}</link>' for name in ("base", "zero_arm", "seven_arm"))
joints = JOINT.format(name="zero", effort=0) + JOINT.format(name="seven", effort=7)
Path("arm.urdf").write_text(f'<robot name="arm">{links}{joints}</robot>')

model = mujoco.MjModel.from_xml_path("arm.urdf")
limited = {model.joint(name).name: bool(model.jnt_actfrclimited[model.joint(name).id]) for name in ("zero", "seven")}
print("MuJoCo limits the force:", limited)
assert limited == {"zero": False, "seven": True}

model = pinocchio.buildModelFromUrdf("arm.urdf")
efforts = {name: float(model.upperEffortLimit[model.joints[model.getJointId(name)].idx_v]) for name in limited}
print("Pinocchio's limits:", efforts)
assert efforts == {"zero": 0.0, "seven": 7.0}

pybullet.connect(pybullet.DIRECT)
robot = pybullet.loadURDF("arm.urdf", useFixedBase=True)
numbers = {pybullet.getJointInfo(robot, n)[1].decode(): n for n in range(pybullet.getNumJoints(robot))}
forces = {name: pybullet.getJointInfo(robot, number)[10] for name, number in numbers.items()}
for number in numbers.values():
    pybullet.setJointMotorControl2(robot, number, pybullet.POSITION_CONTROL, targetPosition=1.0)
for _ in range(480):
    pybullet.stepSimulation()
angles = {name: pybullet.getJointState(robot, number)[0] for name, number in numbers.items()}
print("PyBullet's limits:", forces, "angles after 2 s:", {name: round(a, 3) for name, a in angles.items()})
assert forces == {"zero": 0.0, "seven": 7.0}
assert np.allclose(list(angles.values()), 1.0, atol=0.01), angles
PYTHON
