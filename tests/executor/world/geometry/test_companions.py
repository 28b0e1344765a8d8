"""Files that a mesh file names: found where it says or beside it, never outside, and copied with it."""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from executor.world.geometry.companions import Companions, bundle, has_room, named_files
from executor.world.geometry.mesh import MeshError, load_colored
from tests.executor.world.geometry.test_mesh_colors import DAE, MTL, OBJ
from tests.executor.world.geometry.test_pictures import picture

if TYPE_CHECKING:
    from pathlib import Path

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()
HALF_RED = (pytest.approx(0.707, abs=0.02), 0.0, 0.0, 1.0)


def gltf(uri: str = "bin/a%20b.bin", image: str = "look.png", **more: Any) -> bytes:
    """Returns a triangle as glTF with a picture."""
    surface = {"baseColorTexture": {"index": 0}}
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": uri}],
        "materials": [{"pbrMetallicRoughness": surface}],
        "textures": [{"source": 0}],
        "images": [{"uri": image}],
        **more,
    }
    return json.dumps(tree).encode()


def write(folder: Path, files: dict[str, bytes]) -> None:
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)


def colors(path: Path) -> list[Any]:
    return sorted((color for color, _ in load_colored(path).parts if color is not None), reverse=True)


def test_a_gltf_has_its_buffers_and_the_mean_colour_of_its_picture(tmp_path: Path) -> None:
    write(tmp_path, {"a.gltf": gltf(), "bin/a b.bin": POINTS, "look.png": picture(".png")})
    assert len(load_colored(tmp_path / "a.gltf").whole.indices) == 12
    assert colors(tmp_path / "a.gltf") == [HALF_RED]


def test_a_gltf_may_hold_its_buffer_and_its_colour_itself(tmp_path: Path) -> None:
    inside = "data:application/octet-stream;base64," + base64.b64encode(POINTS).decode()
    plain = [{"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 1]}}]
    write(tmp_path, {"a.gltf": gltf(inside, materials=plain)})
    assert named_files("a.gltf", (tmp_path / "a.gltf").read_bytes()) == ["look.png"]
    assert colors(tmp_path / "a.gltf") == [(0.0, 0.0, 1.0, 1.0)]


@pytest.mark.parametrize("uri", ["../a.bin", "/etc/hostname", "gone.bin", "link.bin"])
def test_a_buffer_that_is_not_there_or_lies_outside_is_refused_by_name(tmp_path: Path, uri: str) -> None:
    folder = tmp_path / "in"
    write(folder, {"a.gltf": gltf(uri)})
    write(tmp_path, {"a.bin": POINTS})
    (folder / "link.bin").symlink_to(tmp_path / "a.bin")
    with pytest.raises(MeshError, match=rf"a.gltf cannot be read: {uri} is not there"):
        load_colored(folder / "a.gltf")


def test_who_may_read_more_finds_what_lies_above(tmp_path: Path) -> None:
    write(tmp_path, {"meshes/a.dae": b"", "textures/look.png": picture(".png")})
    path = tmp_path / "meshes" / "a.dae"
    assert Companions(path).read("../textures/look.png") is None
    assert Companions(path, lambda _: True).read("../textures/look.png") == picture(".png")
    assert Companions(path, lambda _: True, (".mtl",)).read("../textures/look.png") is None


def textured_dae(name: str) -> str:
    """Returns the triangle of COLLADA, with a picture in place of its colour."""
    surface = (
        '<newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>'
        '<newparam sid="p"><sampler2D><source>s</source></sampler2D></newparam>'
    )
    return (
        DAE.replace("<color>1 0 0 1</color>", '<texture texture="p" texcoord="c"/>')
        .replace("<technique sid", f"{surface}<technique sid")
        .replace(
            "<library_effects>",
            f'<library_images><image id="i"><init_from>{name}</init_from></image></library_images>'
            "<library_effects>",
        )
    )


def test_pictures_of_obj_and_collada_have_their_mean_colour(tmp_path: Path) -> None:
    files = {
        "a.obj": OBJ.format("a.mtl").encode(),
        "a.mtl": MTL.replace("missing", "look").encode(),
        "a.dae": textured_dae("../elsewhere/look.png").encode(),
        "look.png": picture(".png"),
    }
    write(tmp_path, files)
    assert colors(tmp_path / "a.obj") == [(1.0, 0.0, 0.0, 1.0), HALF_RED]
    assert colors(tmp_path / "a.dae") == [HALF_RED]
    (tmp_path / "look.png").unlink()
    assert colors(tmp_path / "a.obj") == [(1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)]
    assert load_colored(tmp_path / "a.dae").note == "the materials of a.dae cannot be read"


def test_a_copy_has_what_it_names_beside_it_with_pictures_made_small() -> None:
    files = {
        "lib/a.mtl": MTL.replace("missing", "../look").encode(),
        "../look.png": picture(".png", 512),
        "a.bin": POINTS,
    }
    found = bundle("a.obj", OBJ.format("lib/a.mtl").encode(), files.get)
    assert set(found) == {"a.mtl", "look.png"}
    assert len(found["look.png"]) < len(files["../look.png"])
    assert set(bundle("a.gltf", gltf("a.bin", "../look.png"), files.get)) == {"a.bin", "look.png"}
    assert set(bundle("a.dae", textured_dae("../look.png").encode(), files.get)) == {"look.png"}
    assert bundle("a.gltf", b"[", files.get) == {}


def test_materials_that_name_each_other_are_read_once() -> None:
    files = {
        "a.mtl": b"map_Kd b.mtl\nmap_Kd look.png\n",
        "b.mtl": b"map_Kd a.mtl\n",
        "look.png": picture(".png"),
    }
    assert set(bundle("a.obj", b"mtllib a.mtl\n", files.get)) == {"a.mtl", "look.png"}


@pytest.mark.parametrize(
    "damaged", ['{"buffers": [1]}', '{"buffers": null, "images": {"uri": 1}}', '{"images": [{"uri": 3}]}']
)
def test_a_damaged_gltf_names_nothing(damaged: str) -> None:
    assert named_files("a.gltf", damaged.encode()) == []


def test_a_copy_has_room_where_no_other_file_is() -> None:
    files = {"m/a/a.obj": b"mesh", "m/a/look.png": b"look"}
    assert not has_room("m/a/a.obj", {}, files)
    assert has_room("m/a/a.dae", {"look.png": b"look"}, files)
    assert not has_room("m/a/a.dae", {"look.png": b"other"}, files)
