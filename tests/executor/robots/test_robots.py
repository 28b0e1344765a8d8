from pathlib import Path

import pytest

from executor.robots import RobotError, UrdfError, load_robot, parse_urdf, robot_ids

LINKS = '<robot name="r"><link name="a"/><link name="b"/>{}</robot>'
JOINT = (
    '<joint name="{n}" type="fixed"><parent link="{p}"/><child link="{c}"/>'
    '<origin xyz="1 0 0" rpy="0 0 1.5707963"/></joint>'
)


@pytest.mark.parametrize("robot_id", robot_ids())
def test_every_robot_has_the_links_that_it_names(robot_id: str) -> None:
    config = load_robot(robot_id)
    assert config.lidars
    assert config.cameras
    assert set(config.wheels) <= set(config.urdf.links)


def test_turtle2_is_of_a_turtlebots_size() -> None:
    config = load_robot("turtle2")
    widths = [v.size[0] * 2 for v in config.urdf.links["base_link"].visuals if v.shape == "cylinder"]
    assert max(widths) == pytest.approx(0.355, abs=0.01)
    laser_link, pose = config.urdf.rigid_parent("laser_link")
    assert laser_link == "base_link"
    assert pose[2] == pytest.approx(0.427)


def test_an_unknown_robot_suggests_the_near_one() -> None:
    with pytest.raises(RobotError, match="did you mean 'turtle2'"):
        load_robot("turtle3")


def test_fixed_joints_are_followed_to_the_link_that_moves() -> None:
    urdf = parse_urdf(LINKS.format(JOINT.format(n="j", p="a", c="b")).encode())
    assert urdf.root == "a"
    link, pose = urdf.rigid_parent("b")
    assert link == "a"
    assert pose[:3] == (1, 0, 0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<robot", "robot.urdf:1"),
        ("<model/>", "first element"),
        ('<!DOCTYPE robot [<!ENTITY x "y">]><robot/>', "DOCTYPE"),
        (LINKS.format(""), "one tree"),
        (LINKS.format(JOINT.format(n="j", p="a", c="x")), "'x', which does not exist"),
        (LINKS.format(JOINT.format(n="j", p="a", c="b") + JOINT.format(n="k", p="b", c="a")), "one tree"),
        ('<robot><link name="a"><visual><geometry><torus/></geometry></visual></link></robot>', "<torus>"),
        ('<robot><link name="a"><visual/></link></robot>', "geometry"),
        (
            '<robot><link name="a"><visual><origin xyz="1 2"/><geometry><sphere radius="1"/></geometry>'
            "</visual></link></robot>",
            "three numbers",
        ),
    ],
)
def test_bad_urdfs_are_refused(text: str, message: str) -> None:
    with pytest.raises(UrdfError, match=message):
        parse_urdf(text.encode())


def test_a_projects_own_robot_goes_first(tmp_path: Path) -> None:
    folder = tmp_path / "robots" / "mine"
    folder.mkdir(parents=True)
    shipped = load_robot("turtle2").urdf_path.parent
    (folder / "turtle2.urdf").write_bytes((shipped / "turtle2.urdf").read_bytes())
    document = (shipped / "robot.yaml").read_text()
    (folder / "robot.yaml").write_text(document.replace("name: Turtle 2", "name: Mine"))
    assert load_robot("mine", tmp_path).name == "Mine"
    (folder / "robot.yaml").write_text(document.replace("link: laser_link", "link: ghost"))
    with pytest.raises(RobotError, match="no link 'ghost'"):
        load_robot("mine", tmp_path)
