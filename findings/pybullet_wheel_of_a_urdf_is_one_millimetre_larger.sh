#!/usr/bin/env bash
# Guess: a cylinder of a URDF rolls with its radius, or, as it becomes a polygon, a little less.
# Seen with pybullet 3.2.7 (its wheel for CPython 3.11): it rolls farther. The polygon gets a margin of about
# 1 mm around it, whatever its size: a wheel of 33 mm drives 2.8 % farther than its turns say, one of 100 mm
# 0.8 %, one of 500 mm nothing that shows. With the flag URDF_USE_IMPLICIT_CYLINDER all are within 0.1 %.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check pybullet==3.2.7 numpy==2.4.6
env/bin/python - <<'PYTHON'
import math
from pathlib import Path

import pybullet

SPIN, STEPS, WARM = 2.0, 6000, 1000
URDF = """<robot name="wheel"><link name="wheel">
<inertial><mass value="1"/><inertia ixx="{i}" iyy="{i}" izz="{i}" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin rpy="{turn} 0 0"/><geometry><cylinder radius="{r}" length="{width}"/></geometry></collision>
</link></robot>"""


def rolled(radius, flags):
    """The distance a turning wheel rolls, divided by its angle: the radius by which it drives."""
    pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81)
    pybullet.setTimeStep(0.001)
    floor = pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_PLANE))
    pybullet.changeDynamics(floor, -1, lateralFriction=1)
    text = URDF.format(i=radius**2 / 2, r=radius, width=2 * radius, turn=math.pi / 2)
    Path("wheel.urdf").write_text(text)
    wheel = pybullet.loadURDF("wheel.urdf", [0, 0, radius], flags=flags)
    pybullet.changeDynamics(wheel, -1, lateralFriction=1, linearDamping=0, angularDamping=0)
    pybullet.resetBaseVelocity(wheel, [SPIN * radius, 0, 0], [0, SPIN, 0])
    for step in range(STEPS):
        pybullet.resetBaseVelocity(wheel, pybullet.getBaseVelocity(wheel)[0], [0, SPIN, 0])
        pybullet.stepSimulation()
        if step == WARM - 1:
            began = pybullet.getBasePositionAndOrientation(wheel)[0][0]
    end = pybullet.getBasePositionAndOrientation(wheel)[0][0]
    pybullet.disconnect()
    return (end - began) / (SPIN * (STEPS - WARM) * 0.001)


for radius, least, most in ((0.033, 2.3, 3.3), (0.1, 0.6, 1.0), (0.5, -0.1, 0.1)):
    plain = 100 * (rolled(radius, 0) / radius - 1)
    implicit = 100 * (rolled(radius, pybullet.URDF_USE_IMPLICIT_CYLINDER) / radius - 1)
    print(f"radius {radius} m: {plain:+.2f} % as a polygon, {implicit:+.2f} % as a cylinder")
    assert least < plain < most, plain
    assert abs(implicit) < 0.1, implicit
PYTHON
