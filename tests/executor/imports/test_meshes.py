"""Meshes are written and made smaller."""

from __future__ import annotations

import numpy as np
import trimesh

from executor.imports.meshes import Meshes, simplified, stl
from executor.sdf.files import MemoryFiles
from executor.sdf.includes import load
from executor.world.geometry.mesh import load_triangles
from executor.world.geometry.pictures import mean_color, shrunk
from tests.executor.world.geometry.test_companions import POINTS, gltf, textured_dae
from tests.executor.world.geometry.test_pictures import picture


def test_triangles_are_written_as_stl(tmp_path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    (tmp_path / "a.stl").write_bytes(stl(ball.vertices, ball.faces))
    found = load_triangles(tmp_path / "a.stl")
    assert len(found.faces) == len(ball.faces)
    assert np.allclose(
        sorted(found.vertices[found.faces].sum(axis=(1, 2))),
        sorted(ball.triangles.sum(axis=(1, 2))),
        atol=1e-5,
    )


def test_fewer_triangles_keep_the_form() -> None:
    ball = trimesh.creation.icosphere(subdivisions=5)
    points, faces = simplified(np.asarray(ball.vertices), np.asarray(ball.faces), 2000)
    assert 500 < len(faces) <= 2000
    radii = np.linalg.norm(points[faces.ravel()], axis=1)
    assert np.allclose(radii, 1.0, atol=1e-6)
    assert np.ptp(points[faces.ravel()], axis=0).min() > 1.8


def test_each_file_is_copied_once_under_a_name_of_its_own() -> None:
    ball = trimesh.creation.icosphere(subdivisions=1)
    files = MemoryFiles(
        {"a/x.stl": stl(ball.vertices, ball.faces), "b/x.stl": stl(ball.vertices, ball.faces)}
    )
    said: list[str] = []
    made = Meshes(files, "assets/w", lambda _, message: said.append(message))
    text = "".join(
        f"<mesh><uri>{uri}</uri></mesh>" for uri in ("a/x.stl", "b/x.stl", "a/x.stl", "c/x.stl", "a/x.step")
    )
    root = load(f"<sdf version='1.9'>{text}</sdf>".encode(), "w.sdf", files, lambda *_: None)
    names = [found and found[0] for found in map(made.add, root)]
    assert names == ["assets/w/meshes/x.stl", "assets/w/meshes/x_2.stl", "assets/w/meshes/x.stl", None, None]
    assert set(made.files) == set(names) - {None}
    assert len(said) == 2


def test_a_mesh_has_its_buffers_and_small_pictures_beside_it_in_a_folder_of_its_own() -> None:
    dae = textured_dae("../textures/look.png").encode()
    look = picture(".png", 512)
    files = MemoryFiles(
        {
            "a/meshes/x.dae": dae,
            "a/textures/look.png": look,
            "b/meshes/x.dae": dae,
            "b/textures/look.png": look,
            "c/x.gltf": gltf("a.bin", "../../secret.png"),
            "c/a.bin": POINTS,
            "d/x.gltf": gltf("gone.bin"),
        }
    )
    said: list[str] = []
    made = Meshes(files, "assets/w", lambda _, message: said.append(message))
    uris = ("a/meshes/x.dae", "b/meshes/x.dae", "c/x.gltf", "d/x.gltf")
    text = "".join(f"<mesh><uri>{uri}</uri></mesh>" for uri in uris)
    root = load(f"<sdf version='1.9'>{text}</sdf>".encode(), "w.sdf", files, lambda *_: None)
    names = [found and found[0].removeprefix("assets/w/meshes/") for found in map(made.add, root)]
    assert names == ["x/x.dae", "x_2/x.dae", "x/x.gltf", None]
    assert said == ["the mesh d/x.gltf is left out: x.gltf cannot be read: gone.bin is not there"]
    kept = {path.removeprefix("assets/w/meshes/"): data for path, data in made.files.items()}
    assert set(kept) == {"x/x.dae", "x/look.png", "x_2/x.dae", "x_2/look.png", "x/x.gltf", "x/a.bin"}
    assert (kept["x/x.dae"], kept["x/a.bin"]) == (dae, POINTS)
    assert mean_color(kept["x/look.png"]) == mean_color(look)
    assert len(kept["x/look.png"]) < len(look)


def test_companions_of_one_name_do_not_replace_each_other() -> None:
    red, blue = (picture(".png", side) for side in (32, 48))
    dae, buffers = textured_dae("look.png").encode(), {"a/a.bin": POINTS, "b/a.bin": POINTS}
    files = MemoryFiles(
        {"a/x.gltf": gltf("a.bin"), "a/look.png": red, "b/x.dae": dae, "b/look.png": blue, **buffers}
    )
    made = Meshes(files, "assets/w", lambda *_: None)
    text = "".join(f"<mesh><uri>{uri}</uri></mesh>" for uri in ("a/x.gltf", "b/x.dae"))
    root = load(f"<sdf version='1.9'>{text}</sdf>".encode(), "w.sdf", files, lambda *_: None)
    names = [found and found[0].removeprefix("assets/w/meshes/") for found in map(made.add, root)]
    assert names == ["x/x.gltf", "x_2/x.dae"]
    assert made.files["assets/w/meshes/x/look.png"] == shrunk(red)
    assert made.files["assets/w/meshes/x_2/look.png"] == shrunk(blue)
