"""A user's own robot: meshes, xacro, sensors placed by the configuration; errors have file and line."""

import struct
from pathlib import Path

import numpy as np
import pytest

from executor.robots import RobotError, load_robot
from executor.universes import parse_universe
from executor.world.physics.bullet import BulletWorld

YAML = """\
format: bt-studio/robot
version: 1
name: Cart
urdf: {urdf}
drive: {{left: [left_joint], right: [right_joint], wheel_radius: 0.05, track: 0.3,
        max_linear: 0.5, max_angular: 2}}
wheels: [left, right, nose]
friction: {{nose: 0.0}}
sensors:
  - {{kind: lidar, link: mast, rays: 180, fov: 3.14159, range_max: 5.0}}
  - {{kind: camera, link: mast, width: 64, height: 48}}
"""
XACRO = """\
<robot name="cart" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="radius" value="0.05"/>
  <xacro:macro name="wheel" params="side y">
    <link name="${side}">
      <inertial><mass value="0.2"/>
        <inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0002" iyz="0" izz="0.0002"/></inertial>
      <visual><geometry>
        <mesh filename="package://cart/meshes/wheel.stl" scale="0.05 0.05 0.05"/>
      </geometry></visual>
      <collision><geometry><sphere radius="${radius}"/></geometry></collision>
    </link>
    <joint name="${side}_joint" type="continuous"><parent link="base_link"/><child link="${side}"/>
      <origin xyz="0 ${y} ${radius}"/><axis xyz="0 1 0"/></joint>
  </xacro:macro>
  <link name="base_link">
    <inertial><origin xyz="0 0 0.08"/><mass value="4"/>
      <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial>
    <visual><origin xyz="0 0 0.1"/><geometry><mesh filename="meshes/body.obj"/></geometry></visual>
    <collision><origin xyz="0 0 0.1"/><geometry><mesh filename="meshes/body.obj"/></geometry></collision>
  </link>
  <xacro:wheel side="left" y="0.15"/>
  <xacro:wheel side="right" y="-0.15"/>
  <link name="nose"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
  <joint name="nose_joint" type="fixed"><parent link="base_link"/><child link="nose"/>
    <origin xyz="0.15 0 0.02"/></joint>
  <link name="tail"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
  <joint name="tail_joint" type="fixed"><parent link="base_link"/><child link="tail"/>
    <origin xyz="-0.15 0 0.02"/></joint>
  <link name="mast"/>
  <joint name="mast_joint" type="fixed"><parent link="base_link"/><child link="mast"/>
    <origin xyz="0 0 0.3"/></joint>
</robot>
"""
CUBE = [(x, y, z) for x in (-0.2, 0.2) for y in (-0.12, 0.12) for z in (-0.04, 0.04)]
FACES = [
    *((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)),
    *((2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)),
]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Returns a project with a robot `cart`: the body is an OBJ, the wheels are STL, described in xacro."""
    folder = tmp_path / "robots" / "cart"
    (folder / "meshes").mkdir(parents=True)
    (folder / "robot.yaml").write_text(YAML.format(urdf="cart.urdf.xacro"))
    (folder / "cart.urdf.xacro").write_text(XACRO)
    lines = [f"v {x} {y} {z}" for x, y, z in CUBE] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]
    (folder / "meshes" / "body.obj").write_text("\n".join(lines))
    points = np.array(CUBE, np.float32) * 5
    triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *points[list(face)].ravel(), 0) for face in FACES)
    (folder / "meshes" / "wheel.stl").write_bytes(bytes(80) + struct.pack("<I", len(FACES)) + triangles)
    return tmp_path


def test_it_drives_is_seen_and_measures(project: Path) -> None:
    text = "format: bt-studio/universe\nversion: 1\nname: t\nmodels:\n"
    text += "  - {id: wall, shape: box, size: [0.2, 4, 1], pose: [2, 0, 0.5, 0, 0, 0]}\n"
    world = BulletWorld(parse_universe(text), robot="cart", assets=project)
    robot = world.robots[0]
    for _ in range(20):
        robot.command(0.3, 0.0)
        world.step(12)
    x, y, _ = robot.pose
    assert 0.2 < x < 0.3
    assert abs(y) < 0.005
    lidar = robot.config.lidars[0]
    ranges = robot.scan(lidar).ranges
    assert ranges[89:91] == pytest.approx(1.9 - x, abs=0.02)  # the middle of a half circle is straight ahead
    assert np.isinf(ranges[0])
    assert set(world.scene.meshes) == {"cart/meshes/body.obj", "cart/package://cart/meshes/wheel.stl"}
    meshes = [shape.mesh for o in world.scene.objects for shape in o.shapes if shape.shape == "mesh"]
    assert len(meshes) == 3
    world.close()


def complaint(project: Path) -> str:
    with pytest.raises(RobotError) as caught:
        load_robot("cart", project)
    return str(caught.value)


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_what_is_wrong_in_xacro_is_said_with_its_line(project: Path) -> None:
    file = project / "robots" / "cart" / "cart.urdf.xacro"
    change(file, '<xacro:wheel side="left" y="0.15"/>', '<xacro:whel side="left" y="0.15"/>')
    assert complaint(project).startswith(
        "robots/cart/cart.urdf.xacro:21:1: BTR002 xacro: unknown macro name: xacro:whel"
    )
    change(file, "<xacro:whel", "<xacro:wheel")
    change(file, "${radius}", "${radius / 0}")
    assert "robots/cart/cart.urdf.xacro:10:1: BTR002 xacro: float division by zero" in complaint(project)
    file.write_text("<robot>\n<link\n")
    assert complaint(project).startswith("robots/cart/cart.urdf.xacro:2:1: BTR002")
    file.unlink()
    assert "cannot be read: No such file" in complaint(project)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("meshes/body.obj", "meshes/ghost.obj", "there is no file ghost.obj"),
        ("meshes/body.obj", "../../../../etc/passwd.obj", "lies outside of robots/cart and the project"),
        ("meshes/body.obj", "meshes/body.blend", "meshes of kind .blend are not read"),
    ],
)
def test_a_mesh_that_cannot_be_used_is_named(project: Path, old: str, new: str, message: str) -> None:
    file = project / "robots" / "cart" / "cart.urdf.xacro"
    change(file, old, new)
    urdf = load_robot("cart", project).urdf  # the mesh that is only seen is a box
    assert [note.code for note in urdf.notes] == ["BTR004"]
    assert message in urdf.notes[0].message
    change(file, old, new)
    assert "BTR004" in complaint(project)
    assert message in complaint(project)


@pytest.mark.parametrize(
    "content", ["", "v 0 0 0\n", "f 1 2 3\n", "v 0 0 x\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "\0" * 100]
)
def test_a_broken_mesh_is_refused(project: Path, content: str) -> None:
    (project / "robots" / "cart" / "meshes" / "body.obj").write_text(content)
    assert "BTR004 body.obj" in complaint(project)


def test_a_sensor_at_no_link_is_refused_with_its_line(project: Path) -> None:
    change(project / "robots" / "cart" / "robot.yaml", "link: mast, rays", "link: mst, rays")
    assert (
        complaint(project)
        == "robots/cart/robot.yaml:10:25: BTR003 the URDF has no link 'mst' (did you mean 'mast'?)"
    )
    change(project / "robots" / "cart" / "robot.yaml", "link: mst, rays: 180", "link: mast, rays: 0")
    assert "robots/cart/robot.yaml:10:" in complaint(project)
