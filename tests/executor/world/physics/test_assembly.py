"""URDF and SDF models of a project as models of a universe."""

import math
from pathlib import Path

import numpy as np
import pytest

from executor.universes import UniverseError, parse_universe
from executor.universes.document import DocumentError
from executor.world.geometry.transforms import from_xyz_rpy, yaw_of
from executor.world.physics.bullet import BulletWorld

HEAD = "format: bt-studio/universe\nversion: 1\nname: test\nrobots: []\n"
DOOR = """\
<robot name="door">
  <link name="frame">
    <visual><origin xyz="0 0 1"/><geometry><box size="0.1 0.1 2"/></geometry></visual>
    <collision><origin xyz="0 0 1"/><geometry><box size="0.1 0.1 2"/></geometry></collision>
  </link>
  <link name="leaf">
    <inertial><origin xyz="0.45 0 1"/><mass value="8"/>
      <inertia ixx="2" ixy="0" ixz="0" iyy="2" iyz="0" izz="0.6"/></inertial>
    <visual><origin xyz="0.45 0 1"/><geometry><box size="0.8 0.04 1.9"/></geometry></visual>
    <collision><origin xyz="0.45 0 1"/><geometry><box size="0.8 0.04 1.9"/></geometry></collision>
  </link>
  <joint name="hinge" type="revolute"><parent link="frame"/><child link="leaf"/><axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="1.5" effort="10" velocity="5"/></joint>
</robot>
"""
# A table with its leg beside it in the model's frame, a drawer on a slide, and a lamp without a joint.
TABLE = """\
<sdf version="1.9"><model name="table">
  <link name="top"><pose>0 0 0.7 0 0 0</pose>
    <collision name="c"><geometry><box><size>1 0.6 0.04</size></box></geometry></collision>
    <visual name="v"><geometry><box><size>1 0.6 0.04</size></box></geometry>
      <material><diffuse>0.5 0.25 0 1</diffuse></material></visual>
    <sensor name="s" type="camera"/>
  </link>
  <link name="leg"><pose relative_to="top">0 0 -0.35 0 0 0</pose>
    <collision name="c"><geometry><cylinder><radius>0.05</radius><length>0.7</length></cylinder></geometry>
    </collision>
    <visual name="v"><geometry><cylinder><radius>0.05</radius><length>0.7</length></cylinder></geometry>
    </visual>
  </link>
  <link name="drawer"><pose relative_to="slide"/>
    <visual name="v"><pose>0.1 0 0 0 0 0</pose>
      <geometry><box><size>0.2 0.3 0.1</size></box></geometry></visual>
  </link>
  <link name="lamp"><pose>0.3 0 0.8 0 0 0</pose>
    <visual name="v"><geometry><sphere><radius>0.06</radius></sphere></geometry></visual>
  </link>
  <joint name="fix" type="fixed"><parent>top</parent><child>leg</child></joint>
  <frame name="side" attached_to="top"><pose>0 0.1 -0.1 0 0 1.5707963</pose></frame>
  <joint name="slide" type="prismatic"><pose relative_to="side">0.2 0 0 0 0 0</pose>
    <parent>top</parent><child>drawer</child>
    <axis><xyz expressed_in="__model__">0 1 0</xyz><limit><lower>0</lower><upper>0.25</upper></limit></axis>
  </joint>
  <plugin name="p" filename="x.so"/>
</model></sdf>
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "assets" / "things"
    folder.mkdir(parents=True)
    (folder / "door.urdf").write_text(DOOR)
    (folder / "table.sdf").write_text(TABLE)
    return tmp_path


def world_of(models: str, project: Path) -> BulletWorld:
    return BulletWorld(parse_universe(f"{HEAD}models:\n{models}"), assets=project)


def where(world: BulletWorld) -> dict[str, np.ndarray]:
    poses = world.poses()
    return {f"{o.body}/{o.link}": poses[o.id] for o in world.scene.objects}


def test_a_door_swings_on_its_hinge_and_is_moved_back(project: Path) -> None:
    text = "  - {id: door, shape: urdf, file: assets/things/door.urdf, pose: [2, 0, 0, 0, 0, 1.5707963]}\n"
    ball = "  - {id: ball, shape: sphere, size: [0.2], mass: 6, pose: [1.5, 0.6, 3, 0, 0, 0]}\n"
    ramp = "  - {id: ramp, shape: box, size: [2, 0.5, 0.1], pose: [1, 0.6, 1.2, 0, 0.6, 0]}\n"
    world = world_of(text + ball + ramp, project)
    assert {o.kind for o in world.scene.objects if o.body == "door"} == {"dynamic"}
    world.step(480)
    leaf = where(world)["door/leaf"]
    assert abs(yaw_of(leaf[3:].tolist()) - math.pi / 2) > 0.2
    assert leaf[:3] == pytest.approx([2, 0, 0], abs=0.02)  # it is attached at its frame
    saved = world.save()
    world.step(60)
    world.restore(saved)
    assert where(world)["door/leaf"] == pytest.approx(leaf, abs=1e-5)
    world.move_body("door", [-1, 0, 0, 0, 0, 0])
    assert where(world)["door/frame"] == pytest.approx(from_xyz_rpy((-1, 0, 0, 0, 0, 0)), abs=1e-6)
    world.close()


SHELF = """<robot name="shelf"><link name="l">
<inertial><origin xyz="0.1 0 0.2" rpy="0.3 0 0"/><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><geometry><box size="1 1 0.5"/></geometry></visual>
<collision><origin xyz="0 0 0.25"/><geometry><box size="1 1 0.5"/></geometry></collision></link></robot>"""


def test_what_stands_fast_in_one_piece_is_touched_and_moved(project: Path) -> None:
    (project / "assets" / "things" / "shelf.urdf").write_text(SHELF)
    text = "  - {id: shelf, shape: urdf, file: assets/things/shelf.urdf, pose: [2, 0, 0, 0, 0, 0.5]}\n"
    ball = "  - {id: ball, shape: sphere, size: [0.2], mass: 1, pose: [2, 0, 2, 0, 0, 0]}\n"
    world = world_of(text + ball, project)
    world.step(480)
    assert where(world)["ball/"][2] == pytest.approx(0.7, abs=0.01)
    assert where(world)["shelf/l"] == pytest.approx(from_xyz_rpy((2, 0, 0, 0, 0, 0.5)), abs=1e-6)
    world.move_body("shelf", [5, 0, 0, 0, 0, 0])
    assert where(world)["shelf/l"] == pytest.approx(from_xyz_rpy((5, 0, 0, 0, 0, 0)), abs=1e-6)
    world.step(480)
    assert where(world)["ball/"][2] == pytest.approx(0.2, abs=0.01)
    world.close()


def test_an_sdf_model_has_its_poses(project: Path, caplog: pytest.LogCaptureFixture) -> None:
    world = world_of(
        "  - {id: table, shape: sdf, file: assets/things/table.sdf, pose: [1, 0, 0, 0, 0, 0]}\n", project
    )
    places = where(world)
    assert list(places) == ["table/top", "table/drawer"]  # links that are fixed to the top are merged with it
    assert places["table/top"][:3] == pytest.approx([1, 0, 0])
    assert places["table/drawer"][:3] == pytest.approx([1, 0.3, 0.6])
    top = next(o for o in world.scene.objects if o.link == "top")
    assert [s.shape for s in top.shapes] == ["box", "cylinder", "sphere"]
    assert top.shapes[0].color == [0.5, 0.25, 0.0, 1.0]
    heights = [s.pose[:3] for s in top.shapes]
    assert heights == [pytest.approx(at) for at in ([0, 0, 0.7], [0, 0, 0.35], [0.3, 0, 0.8])]
    said = caplog.text
    assert "table.sdf:" in said
    for words in ("<sensor> of the link 'top'", "no joint holds the link 'lamp'", "<plugin> of the model"):
        assert words in said
    world.close()


PRESS = """<robot name="press"><link name="frame"/>
{}
<joint name="falls" type="prismatic"><parent link="frame"/><child link="weight"/><axis xyz="0 0 1"/>
  <limit lower="-0.5" upper="0" effort="10" velocity="5"/></joint>
<joint name="follows" type="prismatic"><parent link="frame"/><child link="slider"/><axis xyz="1 0 0"/>
  <limit lower="-2" upper="2" effort="10" velocity="5"/>
  <mimic joint="falls" multiplier="-0.5" offset="0.1"/></joint>
</robot>"""
PRESSED = """<link name="{}"><inertial><mass value="1"/>
  <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>"""


def test_a_joint_with_mimic_follows_the_other_one(project: Path) -> None:
    press = PRESS.format(PRESSED.format("weight") + PRESSED.format("slider"))
    (project / "assets/things/press.urdf").write_text(press)
    text = "  - {id: press, shape: urdf, file: assets/things/press.urdf, pose: [0, 0, 2, 0, 0, 0]}\n"
    world = world_of(text, project)
    world.step(480)
    places = where(world)
    assert places["press/weight"][2] == pytest.approx(1.5, abs=0.01)  # it fell to its limit
    assert places["press/slider"][0] == pytest.approx(0.35, abs=0.01)
    world.close()


def test_with_a_mass_it_is_free_and_weighs_that_much(project: Path) -> None:
    world = world_of(
        "  - {id: table, shape: sdf, file: assets/things/table.sdf, mass: 9, pose: [0, 0, 1, 0, 0, 0]}\n",
        project,
    )
    uid = world._content.assemblies["table"].uid
    links = range(-1, world._bullet.getNumJoints(uid))
    assert sum(world._bullet.getDynamicsInfo(uid, link)[0] for link in links) == pytest.approx(9)
    world.step(120)
    assert where(world)["table/top"][2] < 1.2  # it fell
    world.close()


def model(*parts: str) -> str:
    return "<sdf><model name='m'>" + "\n".join(parts) + "</model></sdf>"


def visual(geometry: str) -> str:
    return f"<visual name='v'><geometry>\n{geometry}</geometry></visual>"


A = "<link name='a'/>"


@pytest.mark.parametrize(
    ("file", "text", "message"),
    [
        ("broken.urdf", "<robot>\n<link name='a'>\n</robot>", "broken.urdf:3"),
        (
            "mesh.urdf",
            "<robot><link name='a'><collision><geometry>\n"
            "<mesh filename='no.stl'/></geometry></collision></link></robot>",
            "mesh.urdf:2.*no file no.stl",
        ),
        (
            "mesh.sdf",
            model(
                "<link name='a'><collision name='c'><geometry>",
                "<mesh><uri>model://m/no.stl</uri></mesh></geometry></collision></link>",
            ),
            "mesh.sdf:2.*no file no.stl",
        ),
        ("two.sdf", model(A, A), "two.sdf:2.*twice"),
        (
            "ghost.sdf",
            model(A, "<joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>"),
            "ghost.sdf:2.*'b', which does not exist",
        ),
        (
            "circle.sdf",
            model(
                "<link name='a'/><frame name='e'><pose relative_to='f'/></frame>",
                "<frame name='f'><pose relative_to='e'/></frame>",
                "<joint name='j' type='fixed'><pose relative_to='e'/>",
                "<parent>a</parent><child>b</child></joint>",
                "<link name='b'/>",
            ),
            "circle",
        ),
        (
            "size.sdf",
            model(f"<link name='a'>{visual('<box><size>1 x 1</size></box>')}</link>"),
            "size.sdf:2.*3 numbers",
        ),
        ("entity.sdf", "<!DOCTYPE sdf [<!ENTITY a 'b'>]><sdf/>", "DOCTYPE"),
        ("empty.sdf", "<sdf><world/></sdf>", "no <model>"),
    ],
)
def test_errors_have_file_and_line(project: Path, file: str, text: str, message: str) -> None:
    (project / "assets" / file).write_text(text)
    kind = file.rpartition(".")[2]
    with pytest.raises(DocumentError, match=message):
        world_of(f"  - {{id: thing, shape: {kind}, file: assets/{file}}}\n", project)


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("{id: a, shape: urdf, file: assets/a.sdf}", "ends in .urdf or .xacro"),
        ("{id: a, shape: sdf, file: assets/a.sdf, size: [1]}", "no `size` here"),
        ("{id: a, shape: urdf}", "needs a `file`"),
        ("{id: a, shape: box, size: [1, 1, 1], file: assets/a.obj}", "a box has no `file`"),
    ],
)
def test_a_universe_says_what_a_thing_may_have(model: str, message: str) -> None:
    with pytest.raises(UniverseError, match=message):
        parse_universe(f"{HEAD}models: [{model}]\n")


def test_a_file_that_is_missing_or_elsewhere_is_refused(project: Path) -> None:
    for file, message in (("../etc/x.urdf", "outside of the project"), ("assets/x.urdf", "cannot be read")):
        with pytest.raises(DocumentError, match=message):
            world_of(f"  - {{id: thing, shape: urdf, file: {file}}}\n", project)
    with pytest.raises(DocumentError, match="needs the project's files"):
        BulletWorld(parse_universe(f"{HEAD}models: [{{id: a, shape: urdf, file: assets/a.urdf}}]\n"))


def test_what_falls_on_a_joint_onto_a_standing_robot_hits_it(project: Path) -> None:
    (project / "assets" / "things" / "lift.urdf").write_text(
        """<robot name="lift"><link name="frame"/>
<link name="weight"><inertial><mass value="0.2"/>
  <inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
<joint name="falls" type="prismatic"><parent link="frame"/><child link="weight"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="0" effort="10" velocity="5"/></joint></robot>"""
    )
    text = HEAD.replace("robots: []", "robots:\n  - {id: robot, model: burger, pose: [0, 0, 0, 0, 0, 0]}")
    lift = "  - {id: lift, shape: urdf, file: assets/things/lift.urdf, pose: [0, 0, 0.8, 0, 0, 0]}\n"
    world = BulletWorld(parse_universe(f"{text}models:\n{lift}"), assets=project)
    world.step(480)
    robot = world.robots[0]
    assert (robot.collisions, robot.hits) == (0, 1)
