"""Worlds as their owners have them: included models, frames, doors, meshes, and what is left out."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import cv2
import numpy as np
import pytest
import yaml

from executor.imports.meshes import stl
from executor.imports.worlds import Imported, import_sdf
from executor.sdf.files import MemoryFiles
from executor.universes import UniverseError, parse_universe
from executor.world.physics.bullet import BulletWorld

if TYPE_CHECKING:
    from pathlib import Path

BOX = "<geometry><box><size>{}</size></box></geometry>"
CUBE_POINTS = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
CUBE_FACES = np.array(
    [
        0,
        1,
        3,
        0,
        3,
        2,
        4,
        6,
        7,
        4,
        7,
        5,
        0,
        4,
        5,
        0,
        5,
        1,
        2,
        3,
        7,
        2,
        7,
        6,
        0,
        2,
        6,
        0,
        6,
        4,
        1,
        5,
        7,
        1,
        7,
        3,
    ]
).reshape(-1, 3)


def box(size: str = "1 1 1", pose: str = "") -> str:
    shape = f"{pose}{BOX.format(size)}"
    return f"<visual name='v'>{shape}</visual><collision name='c'>{shape}</collision>"


def alone(inside: str) -> bytes:
    return f"<sdf version='1.9'>{inside}</sdf>".encode()


def model(name: str, inside: str = "", pose: str = "", more: str = "<static>1</static>") -> str:
    return f"<model name='{name}'>{more}{pose}<link name='link'>{inside or box()}</link></model>"


def world(*inside: str, version: str = "1.9") -> bytes:
    return f"<sdf version='{version}'><world name='w'>\n{chr(10).join(inside)}\n</world></sdf>".encode()


def read(text: bytes, files: dict[str, bytes] | None = None, file: str = "world.sdf") -> Imported:
    return import_sdf(text, file, MemoryFiles({**(files or {}), file: text}))


def things(made: Imported) -> dict[str, dict]:
    document = yaml.safe_load(made.text)
    return {thing["id"]: thing for thing in (*document.get("models", ()), *document.get("actors", ()))}


def poses(made: Imported) -> dict[str, list[float]]:
    return {id_: thing["pose"] for id_, thing in things(made).items()}


def said(made: Imported) -> list[str]:
    return [problem.message for problem in made.left_out]


@pytest.mark.parametrize(
    ("pose", "expected"),
    [
        ("<pose>1 2 3 0 0 1</pose>", [1, 2, 3, 0, 0, 1]),
        ("<pose degrees='true'>1 2 3 0 0 90</pose>", [1, 2, 3, 0, 0, math.pi / 2]),
        ("<pose degrees='1'>0 0 0 180 0 0</pose>", [0, 0, 0, math.pi, 0, 0]),
        ("<pose rotation_format='quat_xyzw'>1 0 0 0 0 0.6 0.8</pose>", [1, 0, 0, 0, 0, 2 * math.asin(0.6)]),
        ("<pose relative_to='corner'>1 0 0 0 0 0</pose>", [5, 7, 0, 0, 0, math.pi / 2]),
        ("<pose relative_to='other'>1 0 0 0 0 0</pose>", [5, 8, 0, 0, 0, math.pi / 2]),
        ("<pose relative_to='other::link'>0 0 1 0 0 0</pose>", [5, 7, 1.5, 0, 0, math.pi / 2]),
        ("<pose/>", [0, 0, 0, 0, 0, 0]),
    ],
)
def test_poses_are_where_they_say(pose: str, expected: list[float]) -> None:
    corner = "<frame name='corner'><pose degrees='true'>5 6 0 0 0 90</pose></frame>"
    other = (
        "<model name='other'><static>1</static><pose relative_to='corner'>1 0 0 0 0 0</pose>"
        f"<link name='link'><pose>0 0 0.5 0 0 0</pose>{box()}</link></model>"
    )
    assert poses(read(world(corner, other, model("m", pose=pose))))["m_v"] == pytest.approx(
        expected, abs=1e-5
    )


def test_frames_of_version_1_6_are_those_of_the_attribute_frame() -> None:
    links = (
        "<link name='a'><pose>1 0 0 0 0 0</pose></link>"
        f"<link name='b'><pose frame='a'>0 2 0 0 0 0</pose>{box()}</link>"
    )
    old = world(f"<model name='m'><static>true</static>{links}</model>", version="1.6")
    assert poses(read(old))["m_b_v"][:2] == [1, 2]
    assert poses(read(old.replace(b"1.6", b"1.9")))["m_b_v"][:2] == [0, 2]


@pytest.mark.parametrize("static", ["true", "True", "TRUE", "1", " true "])
def test_what_is_static_has_no_mass(static: str) -> None:
    made = read(world(model("m", more=f"<static>{static}</static>"), model("n", more="")))
    assert {id_: thing.get("mass") for id_, thing in things(made).items()} == {"m_v": None, "n_v": 1.0}


def test_included_models_have_their_place_and_name() -> None:
    inner = f"<sdf version='1.9'>{model('part', pose='<pose>9 9 9 0 0 0</pose>')}</sdf>".encode()
    outer = (
        b"<sdf version='1.9'><model name='outer'><static>1</static>"
        b"<include><uri>model://inner</uri><name>in</name><pose>0 0 2 0 0 0</pose></include></model></sdf>"
    )
    files = {"models/inner/model.sdf": inner, "models/outer/model.sdf": outer}
    include = "<include><uri>model://outer</uri><pose>1 0 0 0 0 0</pose>{}</include>"
    made = read(world(include.format("<name>first</name>"), include.format("")), files, "worlds/a.sdf")
    assert sorted(pose[:3] for pose in poses(made).values()) == [[1, 0, 2], [1, 0, 2]]
    assert [id_.split("_")[0] for id_ in things(made)] == ["first", "outer"]
    assert said(made) == []


def test_the_newest_file_of_a_model_is_read_and_a_pose_of_its_own_counts() -> None:
    config = (
        b"<model><name>A crate</name><sdf version='1.4'>old.sdf</sdf><sdf version='1.9'>new.sdf</sdf></model>"
    )
    files = {
        "models/crate/model.config": config,
        "models/crate/old.sdf": b"<sdf/>",
        "models/crate/new.sdf": alone(model("crate", pose="<pose>3 0 0 0 0 0</pose>")),
    }
    for uri in (
        "model://crate",
        "model://A crate",
        "crate",
        "models/crate",
        "https://fuel.gazebosim.org/1.0/o/models/crate",
    ):
        made = read(world(f"<include><uri>{uri}</uri></include>"), files)
        assert poses(made)["crate_v"][:3] == [3, 0, 0]


@pytest.mark.parametrize(
    ("files", "reason"),
    [
        ({}, "no folder of what is imported is the model 'crate'"),
        (
            {"models/crate/model.config": b"<model><name>crate</name></model>"},
            "there is no file models/crate/model.sdf",
        ),
        ({"models/crate/model.sdf": b"<sdf version='1.9'><model"}, "models/crate/model.sdf:1"),
        ({"models/crate/model.sdf": b"<sdf version='99'/>"}, "the version '99' of SDF is not known"),
        (
            {
                "models/crate/model.sdf": b"<sdf version='1.9'><model name='c'><include><uri>model://crate</uri></include></model></sdf>"
            },
            "the files include each other",
        ),
    ],
)
def test_what_cannot_be_included_is_listed(files: dict[str, bytes], reason: str) -> None:
    made = read(world(model("m"), "<include><uri>model://crate</uri></include>"), files)
    assert list(things(made)) == ["m_v"]
    assert [message for message in said(made) if reason in message]


def test_a_placement_frame_stands_where_the_pose_says() -> None:
    foot = "<static>1</static><frame name='foot'><pose>0 0 -1 0 0 0</pose></frame>"
    crate = alone(model("crate", more=foot))
    place = "<placement_frame>foot</placement_frame><pose>4 0 0 0 0 0</pose>"
    include = f"<include><uri>model://crate</uri>{place}</include>"
    assert poses(read(world(include), {"crate/model.sdf": crate}))["crate_v"][:3] == [4, 0, 1]


def test_two_included_models_of_one_name_are_both_there() -> None:
    crate = f"<sdf version='1.9'>{model('crate')}</sdf>".encode()
    made = read(world("<include><uri>model://crate</uri></include>" * 2), {"crate/model.sdf": crate})
    assert len(things(made)) == 2


DOOR = """<model name='door'><pose>3 0 0 0 0 0</pose>
<link name='leaf'><pose>0 0.5 1 0 0 0</pose><inertial><mass>2</mass>
<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>{box}</link>
<joint name='hinge' type='{kind}'><pose>0 -0.5 0 0 0 0</pose><parent>world</parent><child>leaf</child>
<axis><xyz>{axis}</xyz><limit><lower>-1.5</lower><upper>1.5</upper></limit></axis></joint></model>"""
PUSHER = """<model name='ball'><pose>2.5 0.8 1.0 0 0 0</pose><link name='link'>
<inertial><mass>3</mass></inertial>
<visual name='v'><geometry><sphere><radius>0.2</radius></sphere></geometry></visual>
<collision name='c'><geometry><sphere><radius>0.2</radius></sphere></geometry></collision></link></model>"""


def run(tmp_path: Path, made: Imported, push: float = 0.0) -> dict[str, list[float]]:
    for path, raw in made.files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(raw)
    running = BulletWorld(parse_universe(made.text), assets=tmp_path)
    if push:
        bullet = running._bullet  # a shove, as nobody else can give it
        for uid in range(bullet.getNumBodies()):
            if abs(bullet.getDynamicsInfo(uid, -1)[0] - 3.0) < 1e-6:
                bullet.resetBaseVelocity(uid, [push, 0, 0])
    running.step(120)
    where = running.poses()
    found = {f"{o.body}/{o.link}": where[o.id].tolist() for o in running.scene.objects}
    running.close()
    return found


def test_a_door_that_hangs_on_the_world_opens(tmp_path: Path) -> None:
    made = read(world(DOOR.format(box=box("0.1 1 2"), kind="revolute", axis="0 0 1"), PUSHER))
    assert said(made) == []
    door = things(made)["door"]
    assert (door["shape"], door["pose"][:3], "mass" in door) == ("urdf", [3, 0, 0], False)
    leaf = run(tmp_path, made, push=4.0)["door/leaf"]
    assert abs(2 * math.atan2(leaf[5], leaf[6])) > 0.2


def test_a_lift_on_a_rail_to_the_world_sinks(tmp_path: Path) -> None:
    made = read(world(DOOR.format(box=box("1 1 0.1"), kind="prismatic", axis="0 0 1")))
    assert run(tmp_path, made)["door/leaf"][2] < 0.9


def test_links_without_joints_are_loose_and_chained_ones_hang_together(tmp_path: Path) -> None:
    links = (
        f"<link name='a'>{box('0.2 0.2 0.2')}</link>"
        f"<link name='b'><pose>1 0 2 0 0 0</pose>{box('0.2 0.2 0.2')}</link>"
        f"<link name='c'><pose>1 0 3 0 0 0</pose>{box('0.2 0.2 0.2')}</link>"
        "<joint name='j' type='fixed'><parent>b</parent><child>c</child></joint>"
    )
    made = read(world(f"<model name='m'>{links}</model>"))
    assert {id_: thing.get("mass") for id_, thing in things(made).items()} == {"m_a_v": 1.0, "m_b": 2.0}
    assert said(made) == []


def test_what_is_touched_otherwise_than_seen_keeps_both(tmp_path: Path) -> None:
    small, large = BOX.format("1 1 1"), BOX.format("2 2 2")
    inside = f"<visual name='v'>{small}</visual><collision name='c'>{large}</collision>"
    made = read(world(model("shelf", inside), PUSHER.replace("2.5 0.8 1.0", "0 0 2")))
    assert things(made)["shelf"]["shape"] == "urdf"
    [ball] = [pose for name, pose in run(tmp_path, made).items() if name.startswith("ball_v")]
    assert ball[2] == pytest.approx(1.2, abs=0.02)


def test_a_wall_and_a_ramp_of_planes_have_their_normal() -> None:
    plane = (
        "<visual name='v'><geometry><plane><normal>{}</normal><size>2 3</size></plane></geometry></visual>"
    )
    made = read(world(model("wall", plane.format("1 0 0")), model("flat", plane.format("0 0 1"))))
    roll, pitch, _ = poses(made)["wall_v"][3:]
    assert (abs(roll), abs(pitch)) == pytest.approx((0, math.pi / 2), abs=1e-5)
    assert poses(made)["flat_v"][3:] == [0, 0, 0]


def test_meshes_are_copied_and_scaled(tmp_path: Path) -> None:
    mesh = "<geometry><mesh><uri>{}</uri><scale>1 2 {}</scale></mesh></geometry>"
    inside = "".join(
        f"<{tag} name='x'>{mesh.format('model://shop/meshes/a b.stl', '1')}</{tag}>"
        for tag in ("visual", "collision")
    )
    mirrored = f"<visual name='m'>{mesh.format('file://models/shop/meshes/a b.stl', '-1')}</visual>"
    missing = f"<visual name='n'>{mesh.format('model://shop/meshes/none.stl', '1')}</visual>"
    files = {
        "models/shop/model.config": b"<model><name>shop</name></model>",
        "models/shop/meshes/a b.stl": stl(CUBE_POINTS, CUBE_FACES),
    }
    made = read(world(model("m", inside), model("n", mirrored + missing)), files)
    found = things(made)
    assert found["m_x"]["file"] == "assets/world/meshes/a_b.stl"
    assert found["m_x"]["size"] == [1, 2, 1]
    assert made.files["assets/world/meshes/a_b.stl"] == files["models/shop/meshes/a b.stl"]
    assert found["n_m"]["size"] == [1, 2, 1]
    assert found["n_m"]["file"] != found["m_x"]["file"]
    [message] = said(made)
    assert "none.stl is left out" in message
    assert run(tmp_path, made)


def test_a_part_of_a_mesh_is_cut_out_and_centred() -> None:
    obj = "o left\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no right\nv 5 0 0\nv 7 0 0\nv 5 2 0\nf 4 5 6\n"
    mesh = (
        "<visual name='v'><geometry><mesh><uri>two.obj</uri>"
        "<submesh><name>{}</name><center>true</center></submesh></mesh></geometry></visual>"
    )
    made = read(
        world(model("a", mesh.format("right")), model("b", mesh.format("none"))), {"two.obj": obj.encode()}
    )
    [raw] = made.files.values()
    corners = np.frombuffer(raw[84:], [("n", "<f4", 3), ("p", "<f4", (3, 3)), ("m", "<u2")])["p"].reshape(
        -1, 3
    )
    assert corners.min(axis=0).tolist() == [-1, -1, 0]
    assert said(made) == ["the mesh two.obj is left out: two.obj has no part 'none'"]


def test_a_heightmap_is_a_mesh_with_the_north_above() -> None:
    picture = np.zeros((5, 5), np.uint8)
    picture[0, :] = 255
    raw = cv2.imencode(".png", picture)[1].tobytes()
    shape = "<geometry><heightmap><uri>h.png</uri><size>10 20 3</size><pos>0 0 1</pos></heightmap></geometry>"
    made = read(world(model("hill", f"<visual name='v'>{shape}</visual>")), {"h.png": raw})
    [stl_raw] = made.files.values()
    corners = np.frombuffer(stl_raw[84:], [("n", "<f4", 3), ("p", "<f4", (3, 3)), ("m", "<u2")])["p"].reshape(
        -1, 3
    )
    assert (corners.min(axis=0).tolist(), corners.max(axis=0).tolist()) == ([-5, -10, 1], [5, 10, 4])
    assert (corners[corners[:, 2] > 3][:, 1] == 10).all()


@pytest.mark.parametrize("simplify", [True, False])
def test_a_mesh_of_too_many_triangles_is_made_smaller_on_demand(simplify: bool) -> None:
    side = np.linspace(0, 1, 420)
    points = np.stack([*np.meshgrid(side, side), np.zeros((420, 420))], axis=-1).reshape(-1, 3)
    corner = (np.arange(419)[:, None] * 420 + np.arange(419)).ravel()
    faces = np.concatenate(
        [[corner, corner + 1, corner + 420], [corner + 1, corner + 421, corner + 420]], axis=1
    ).T
    inside = "<visual name='v'><geometry><mesh><uri>big.stl</uri></mesh></geometry></visual>"
    data = world(model("big", inside), model("small"))
    made = import_sdf(data, "world.sdf", MemoryFiles({"big.stl": stl(points, faces)}), simplify=simplify)
    [message] = said(made)
    if simplify:
        assert "had 351122 triangles; it has" in message
        assert set(things(made)) == {"big_v", "small_v"}
    else:
        assert "import again with simplify" in message
        assert set(things(made)) == {"small_v"}


def test_lights_shine_as_they_are_turned() -> None:
    light = "<light name='s' type='directional'><pose degrees='true'>0 0 9 90 0 0</pose></light>"
    document = yaml.safe_load(read(world(light, model("m"))).text)
    assert document["lights"][0]["direction"] == pytest.approx([0, 1, 0], abs=1e-6)


def test_all_that_is_left_out_is_listed() -> None:
    made = read(
        world(
            "<gravity>0 0 -1.6</gravity>",
            "<gz:system>x</gz:system>",
            "<wind/>",
            model("m", box() + "<sensor name='s' type='camera'/><gravity>false</gravity>"),
            model("n", "<visual name='v'><geometry><cone/></geometry></visual>"),
            "<actor name='a'><plugin/></actor>",
        )
    )
    text = "\n".join(said(made))
    for words in (
        "<gravity>",
        "<gz:system>",
        "<wind>",
        "<sensor>",
        "no gravity",
        "<cone>",
        "<plugin>",
        "waypoints",
    ):
        assert words in text


def test_a_joint_of_a_link_that_is_not_there_costs_the_joint_alone() -> None:
    include = "<include><uri>model://wing</uri><name>wing</name></include>"
    joint = "<joint name='j' type='fixed'><parent>link</parent><child>wing::tip</child></joint>"
    made = read(world(model("plane", more=f"{include}\n{joint}")))
    assert list(things(made)) == ["plane_v"]
    assert [problem.line for problem in made.left_out] == [2, 3]
    assert "the joint 'j' is left out" in made.left_out[1].message


def test_a_second_world_and_a_model_without_a_shape_are_listed() -> None:
    other = world(model("far")).decode().removeprefix("<sdf version='1.9'>").removesuffix("</sdf>")
    none = "<model name='none'><link name='l'/></model>"
    made = read(world(model("near"), none).replace(b"</sdf>", other.encode() + b"</sdf>"))
    assert list(things(made)) == ["near_v"]
    messages = [problem.message for problem in made.left_out]
    assert messages == [
        "the model 'none' has no shape: nothing of it is here",
        "the world 'w' is left out: the first is taken",
    ]


def test_more_things_than_a_universe_may_have_are_left_out_and_said() -> None:
    made = read(world(*(model(f"m{i}") for i in range(2010))))
    assert len(things(made)) == 2000
    assert said(made) == ["10 things are left out: 2000 are the most"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (world("<light name='l' type='directional'/>"), "nothing of this world was imported"),
        (world("<include><uri>model://crate</uri></include>"), "nothing of this world was imported"),
        (b"<sdf version='99'><world name='w'/></sdf>", "1.0 to 1.12"),
        (b"<sdf version='1.9'><world name='w'><model/></world></sdf>", "link|nothing"),
        (world(model("m", pose="<pose relative_to='x'>0 0 0 0 0 0</pose>")), "'x' does not exist"),
        (
            world(
                "<frame name='a' attached_to='b'/><frame name='b' attached_to='a'/>",
                model("m", pose="<pose relative_to='a'/>"),
            ),
            "circle",
        ),
        (world(model("m", pose="<pose rotation_format='x'>0 0 0 0 0 0</pose>")), "euler_rpy or quat_xyzw"),
    ],
)
def test_worlds_that_cannot_be_read_are_refused(text: bytes, message: str) -> None:
    with pytest.raises(UniverseError, match=message):
        read(text)
