"""SDF worlds: the supported part is imported, the rest is listed with its line."""

import pytest

from executor.imports.worlds import import_sdf
from executor.universes import UniverseError, parse_universe
from executor.world.physics.bullet import BulletWorld

WORLD = b"""<?xml version="1.0"?>
<sdf version="1.9">
  <world name="yard">
    <physics type="ode"/>
    <light name="sun" type="directional"><direction>-0.5 0.1 -0.9</direction></light>
    <light name="lamp" type="point"/>
    <include><uri>model://oak_tree</uri></include>
    <model name="ground"><static>true</static><link name="link">
      <visual name="v"><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry></visual>
    </link></model>
    <model name="house wall"><static>true</static><pose>2 0 0 0 0 1.5707963</pose>
      <link name="link"><pose>1 0 0.5 0 0 0</pose>
        <collision name="c"><geometry><box><size>4 0.2 1</size></box></geometry></collision>
        <visual name="visual"><geometry><box><size>4 0.2 1</size></box></geometry>
          <material><diffuse>1 0.5 0 1</diffuse></material></visual>
      </link>
      <plugin name="p" filename="x.so"/>
    </model>
    <model name="ball"><pose>-1 0 1 0 0 0</pose><link name="link">
      <inertial><mass>0.4</mass></inertial>
      <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
      <visual name="visual"><geometry><sphere><radius>0.1</radius></sphere></geometry></visual>
    </link></model>
    <model name="rug"><static>1</static><link name="l">
      <visual name="top"><geometry><plane><size>1 2</size></plane></geometry></visual>
      <visual name="heap"><geometry><heightmap/></geometry></visual>
    </link></model>
    <actor name="guard"><script><trajectory id="0" type="walk">
      <waypoint><time>0</time><pose>0 3 0 0 0 0</pose></waypoint>
      <waypoint><time>4</time><pose>2 3 0 0 0 0</pose></waypoint>
      <waypoint><time>8</time><pose>0 3 0 0 0 0</pose></waypoint>
    </trajectory></script></actor>
  </world>
</sdf>
"""


def test_what_we_have_is_taken_over() -> None:
    universe = parse_universe(import_sdf(WORLD).text)
    models = {model.id: model for model in universe.models}
    assert universe.name == "yard"
    assert list(models) == ["house_wall", "ball", "rug_l_top"]
    wall = models["house_wall"]
    assert wall.pose == pytest.approx((2, 1, 0.5, 0, 0, 1.570796), abs=1e-4)
    assert (wall.size, wall.color, wall.mass, wall.solid) == ((4, 0.2, 1), "#ff8000", 0, True)
    assert models["ball"].mass == 0.4
    assert not models["rug_l_top"].solid
    [guard] = universe.actors
    assert (guard.path, guard.speed, guard.loop) == (((0, 3), (2, 3)), 0.5, True)
    assert universe.lights[0].direction == (-0.5, 0.1, -0.9)


def test_it_runs() -> None:
    world = BulletWorld(parse_universe(import_sdf(WORLD).text))
    world.step(240)
    ball = next(o.id for o in world.scene.objects if o.body == "ball")
    assert world.poses()[ball][2] == pytest.approx(0.1, abs=0.01)
    world.close()


def test_what_was_left_out_is_listed_with_its_line() -> None:
    left_out = [(problem.line, problem.message) for problem in import_sdf(WORLD).left_out]
    assert left_out == [
        (4, "<physics> has no counterpart here"),
        (6, "the light 'lamp' is not sunlight"),
        (7, "<include> of model://oak_tree: model://oak_tree is not there: only world.sdf was given"),
        (17, "<plugin> of the model 'house wall' is not simulated"),
        (26, "the <heightmap> without a uri is left out: it names no picture"),
    ]


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        (b"</sdf>", b"", 35, "Premature end"),
        (b"<sdf ", b'<!DOCTYPE sdf [<!ENTITY x "y">]><sdf ', 1, "DOCTYPE"),
        (
            b"4 0.2 1</size></box></geometry>\n",
            b"4 0.2</size></box></geometry>\n",
            14,
            "3 numbers, not '4 0.2'",
        ),
        (
            b"<radius>0.1</radius></sphere></geometry></visual>",
            b"<radius>nan</radius></sphere></geometry></visual>",
            22,
            "1 number",
        ),
    ],
)
def test_bad_worlds_are_refused_with_their_line(old: bytes, new: bytes, line: int, message: str) -> None:
    assert old in WORLD
    with pytest.raises(UniverseError, match=message) as caught:
        import_sdf(WORLD.replace(old, new))
    assert caught.value.problems[0].line == line


def test_another_document_is_refused() -> None:
    with pytest.raises(UniverseError, match="no <world>"):
        import_sdf(b"<robot/>")
