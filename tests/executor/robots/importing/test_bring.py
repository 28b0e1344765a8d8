"""The files that an import makes: a plain URDF, its meshes, and a `robot.yaml` that loads."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.headless.trial_drive import write_robot
from executor.robots import load_robot
from executor.robots.importing.bring import make_robot, places_of
from executor.universes.document import DocumentError
from executor.world.geometry.pictures import shrunk
from tests.executor.robots.importing.carts import BODY, CASTOR, PAIR, robot
from tests.executor.world.geometry.test_companions import textured_dae
from tests.executor.world.geometry.test_pictures import picture

if TYPE_CHECKING:
    from pathlib import Path

ARM = """<link name="arm"><visual><geometry><mesh filename="{mesh}"/></geometry></visual></link>
<joint name="arm_joint" type="revolute"><parent link="base_link"/><child link="arm"/><origin xyz="0 0 0.2"/>
<axis xyz="0 0 1"/><limit lower="0.5" upper="1" effort="3" velocity="1"/></joint>
<link name="hand"/><joint name="hand_joint" type="continuous"><parent link="arm"/><child link="hand"/>
<mimic joint="arm_joint"/></joint>"""
GAZEBO = """<gazebo reference="arm"><sensor name="eye" type="camera"/><sensor name="g" type="gps"/></gazebo>
<gazebo><plugin filename="libother.so"/></gazebo><sensor_mount/>"""
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """Returns a workspace's package with a robot in xacro and a mesh."""
    cart = tmp_path / "src" / "cart_description"
    for name in ("urdf", "meshes"):
        (cart / name).mkdir(parents=True)
    (cart / "package.xml").write_text("<package><name>cart_description</name></package>")
    (cart / "meshes" / "arm.obj").write_text(TRIANGLE)
    text = robot(
        BODY, PAIR, CASTOR.format(x=0.1), ARM.format(mesh="$(find cart_description)/meshes/arm.obj"), GAZEBO
    )
    (cart / "urdf" / "cart.urdf.xacro").write_text(text.replace("<robot", '<robot xmlns:xacro="http://x"'))
    return cart


def test_a_package_becomes_a_robot_that_loads_as_it_is_written(package: Path, tmp_path: Path) -> None:
    file = package / "urdf" / "cart.urdf.xacro"
    made = make_robot(file, "mine", places_of(file, package, None))
    files = made.written(file.name)
    assert sorted(files) == ["meshes/arm.obj", "mine.urdf", "robot.yaml"]
    assert files["robot.yaml"].startswith(b"# Imported from cart.urdf.xacro.\n")
    assert b'filename="meshes/arm.obj"' in files["mine.urdf"]
    write_robot(files, tmp_path / "project" / "robots" / "mine")
    loaded = load_robot("mine", tmp_path / "project")
    assert loaded.urdf.notes == ()
    assert loaded.wheels == ("left", "right", "nose")
    assert loaded.friction == {"nose": 0.0}
    [motor] = loaded.joints
    assert (motor.joint, motor.topic, motor.torque, motor.start) == (
        "arm_joint",
        "/arm_joint/command",
        3.0,
        0.5,
    )
    assert [camera.link for camera in loaded.cameras] == ["arm"]
    report = made.report
    assert "the joint hand_joint follows arm_joint" in report.taken
    left_out = "\n".join(report.left_out)
    for part in ("(GPS)", "<sensor_mount> is not read", "the plugin libother.so does not run here"):
        assert part in left_out
    assert all(line.startswith("cart.urdf.xacro:") for line in report.left_out)


def test_a_mesh_comes_with_what_it_names(package: Path, tmp_path: Path) -> None:
    (package / "meshes" / "arm.obj").write_text(f"mtllib arm.mtl\nusemtl m\n{TRIANGLE}")
    (package / "meshes" / "arm.mtl").write_text("newmtl m\nKd 0 0 1\nmap_Kd ../textures/look.png\n")
    (package / "textures").mkdir()
    (package / "textures" / "look.png").write_bytes(picture(".png"))
    file = package / "urdf" / "cart.urdf.xacro"
    files = make_robot(file, "mine", places_of(file, package, None)).written(file.name)
    assert {"meshes/arm/arm.obj", "meshes/arm/arm.mtl", "meshes/arm/look.png"} < set(files)
    write_robot(files, tmp_path / "project" / "robots" / "mine")
    loaded = load_robot("mine", tmp_path / "project")
    assert loaded.urdf.notes == ()
    [shown] = [visual for link in loaded.urdf.links.values() for visual in link.visuals if visual.file]
    assert shown.color == pytest.approx((0.707, 0, 0, 1), abs=0.02)


def test_two_meshes_of_one_stem_keep_their_own_pictures(package: Path) -> None:
    meshes, file = package / "meshes", package / "urdf" / "cart.urdf.xacro"
    (meshes / "arm.obj").write_text(f"mtllib arm.mtl\nusemtl m\n{TRIANGLE}")
    (meshes / "arm.mtl").write_text("newmtl m\nmap_Kd look.png\n")
    (meshes / "look.png").write_bytes(picture(".png", 32))
    (package / "other").mkdir()
    (package / "other" / "arm.dae").write_text(textured_dae("look.png"))
    (package / "other" / "look.png").write_bytes(picture(".png", 48))
    mesh = '<geometry><mesh filename="$(find cart_description)/{}"/></geometry>'
    visual = f"<visual>{mesh.format('meshes/arm.obj')}</visual>"
    file.write_text(
        file.read_text().replace(visual, f"{visual}<visual>{mesh.format('other/arm.dae')}</visual>")
    )
    files = make_robot(file, "mine", places_of(file, package, None)).files
    assert files["meshes/arm/look.png"] == shrunk(picture(".png", 32))
    assert files["meshes/arm_2/look.png"] == shrunk(picture(".png", 48))
    assert {"meshes/arm/arm.obj", "meshes/arm_2/arm.dae"} < set(files)


def test_a_mesh_that_is_missing_is_left_out_and_the_robot_still_loads(package: Path, tmp_path: Path) -> None:
    (package / "meshes" / "arm.obj").unlink()
    file = package / "urdf" / "cart.urdf.xacro"
    made = make_robot(file, "mine", places_of(file, package, None))
    assert any("arm.obj: a box is shown in its place" in line for line in made.report.left_out)
    write_robot(made.written(file.name), tmp_path / "robots" / "mine")
    assert load_robot("mine", tmp_path).drive.left == ("left_joint",)


SDF = """<sdf version="1.9"><model name="bot"><link name="base"><inertial><mass>2</mass></inertial>
<sensor name="s" type="imu"/>
<sensor name="t" type="sonar"/></link>{wheels}
<plugin filename="gz-sim-diff-drive-system" name="d"><left_joint>l_j</left_joint>
<right_joint>r_j</right_joint></plugin></model></sdf>"""
WHEEL = """<link name="{n}"><pose>0 {y} 0.1 -1.5707963 0 0</pose><collision name="c"><geometry><cylinder>
<radius>0.1</radius><length>0.02</length></cylinder></geometry></collision></link>
<joint name="{n}_j" type="revolute"><parent>base</parent><child>{n}</child>
<axis><xyz>0 0 1</xyz></axis></joint>"""


def test_an_sdf_model_has_its_sensors_and_its_plugin(tmp_path: Path) -> None:
    wheels = "".join(WHEEL.format(n=n, y=y) for n, y in (("l", 0.2), ("r", -0.2)))
    (tmp_path / "model.sdf").write_text(SDF.format(wheels=wheels))
    made = make_robot(tmp_path / "model.sdf", "bot", places_of(tmp_path / "model.sdf", tmp_path, None))
    assert made.document["sensors"][0]["kind"] == "imu"
    assert (made.base.left, made.base.radius) == (("l_j",), pytest.approx(0.1))
    assert "model.sdf:3: the sensor 't' (sonar) is not simulated" in made.report.left_out
    assert not any("<sensor>" in line or "<plugin>" in line for line in made.report.left_out)
    assert b"bt-studio-line" not in made.files["bot.urdf"]


def test_packages_are_searched_in_the_own_one_then_in_what_is_imported(package: Path, tmp_path: Path) -> None:
    file = package / "urdf" / "cart.urdf.xacro"
    assert [place.folder for place in places_of(file, file, None)] == [package, tmp_path / "src"]
    assert [place.folder for place in places_of(file, package, None)] == [package]
    found = places_of(file, package, tmp_path / "more")
    assert [place.folder for place in found] == [package, tmp_path / "more"]
    alone = tmp_path / "alone" / "bot.urdf"
    alone.parent.mkdir()
    assert [place.folder for place in places_of(alone, alone, None)] == [alone.parent]


def test_a_file_that_is_wrong_is_refused_with_its_line(package: Path) -> None:
    file = package / "urdf" / "cart.urdf.xacro"
    file.write_text("<robot>\n<link/></robot>")
    with pytest.raises(DocumentError, match=r"cart\.urdf\.xacro:2:1: BTR002 a link needs a name"):
        make_robot(file, "mine", places_of(file, file, None))
