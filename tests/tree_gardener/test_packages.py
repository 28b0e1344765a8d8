"""Names of packages and models lead to folders; nothing leads out of the places that are searched."""

import os
import pathlib

import pytest

from tree_gardener.packages import (
    MissingPackageError,
    PackageError,
    Packages,
    Place,
    installed_places,
    manifest_name,
    nearest,
    package_folders,
)


def package(folder: pathlib.Path, name: str) -> pathlib.Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(f"<package format='3'><name> {name} </name></package>")
    return folder


def searched(near: pathlib.Path, root: pathlib.Path) -> Packages:
    return Packages(near, [Place("the project", root)])


def test_a_package_is_the_folder_whose_manifest_has_its_name(tmp_path: pathlib.Path) -> None:
    cart = package(tmp_path / "robots" / "cart", "cart_description")
    (cart / "urdf").mkdir()
    packages = searched(cart / "urdf", tmp_path)
    assert packages.folder("cart_description").samefile(cart)
    assert packages.file("package://cart_description/meshes/a%20b.stl").name == "a b.stl"
    assert packages.file("../meshes/a.stl").resolve() == cart.resolve() / "meshes" / "a.stl"
    assert packages.file(f"file://{cart.resolve()}/a.stl") == cart.resolve() / "a.stl"
    assert packages.notes == []


def test_a_model_is_found_by_its_name_and_by_that_of_its_folder(tmp_path: pathlib.Path) -> None:
    crate = tmp_path / "models" / "crate"
    crate.mkdir(parents=True)
    (crate / "model.config").write_text("<model><author><name>N</name></author><name>A crate</name></model>")
    packages = searched(tmp_path, tmp_path)
    for name in ("crate", "A crate"):
        assert packages.folder(name).samefile(crate)
    assert packages.file("model://crate/mesh.dae").parent.samefile(crate)
    with pytest.raises(MissingPackageError):
        packages.folder("N")


def test_of_two_folders_of_one_name_the_nearest_counts_and_it_is_said(tmp_path: pathlib.Path) -> None:
    one, two = package(tmp_path / "a" / "arm", "arm"), package(tmp_path / "b" / "arm", "arm")
    packages = searched(two / "urdf", tmp_path)
    assert packages.folder("arm").samefile(two)
    assert packages.folder("arm").samefile(two)
    [note] = packages.notes
    assert note == (
        "'arm' is the name of 2 folders: b/arm of the project is the nearest, "
        "so a/arm of the project is not used"
    )
    assert searched(one, tmp_path).folder("arm").samefile(one)


def test_a_name_that_nobody_has_is_one_sentence_that_says_what_to_do(tmp_path: pathlib.Path) -> None:
    places = [Place("robots/cart", tmp_path / "robots"), Place("the project", tmp_path)]
    with pytest.raises(MissingPackageError) as missing:
        Packages(tmp_path, places).file("package://ghost/a.stl")
    assert str(missing.value) == (
        "no folder is the package 'ghost': robots/cart and the project were searched; copy the folder whose "
        "package.xml or model.config has that name into robots/cart"
    )


@pytest.mark.parametrize(
    "name",
    ["package://arm/../../secret", "../../secret", "file:///etc/passwd", "/etc/passwd", "package://arm/out"],
)
def test_nothing_outside_is_read(tmp_path: pathlib.Path, name: str) -> None:
    root = tmp_path / "project"
    arm = package(root / "arm", "arm")
    (tmp_path / "secret").write_text("secret")
    (arm / "out").symlink_to(tmp_path / "secret")
    with pytest.raises(PackageError, match="lies outside of the project"):
        searched(arm, root).file(name)


def test_links_to_packages_elsewhere_and_built_or_ignored_folders_are_not_searched(
    tmp_path: pathlib.Path,
) -> None:
    root = tmp_path / "project"
    package(tmp_path / "elsewhere", "arm")
    root.mkdir()
    (root / "arm").symlink_to(tmp_path / "elsewhere")
    (root / "linked").mkdir()
    (root / "linked" / "package.xml").symlink_to(tmp_path / "elsewhere" / "package.xml")
    package(root / "install" / "arm", "arm")
    package(root / "old" / "arm", "arm")
    (root / "old" / "COLCON_IGNORE").touch()
    with pytest.raises(MissingPackageError):
        searched(root, root).folder("arm")


def test_what_is_installed_is_searched_last(tmp_path: pathlib.Path) -> None:
    (tmp_path / "ros" / "share" / "arm").mkdir(parents=True)
    (tmp_path / "models" / "crate").mkdir(parents=True)
    installed = installed_places(
        {
            "AMENT_PREFIX_PATH": f"{tmp_path / 'ros'}{os.pathsep}",
            "GAZEBO_MODEL_PATH": str(tmp_path / "models"),
        }
    )
    project = tmp_path / "project"
    packages = Packages(project, [Place("the project", project)], installed)
    assert packages.folder("arm").samefile(tmp_path / "ros" / "share" / "arm")
    assert packages.file("model://crate/m.dae").parent.samefile(tmp_path / "models" / "crate")
    with pytest.raises(MissingPackageError):
        packages.folder("..")
    own = package(project / "arm", "arm")
    assert Packages(project, [Place("the project", project)], installed).folder("arm").samefile(own)


def test_folders_of_files_in_memory() -> None:
    files = {
        "src/a/package.xml": b"<package><name>pkg</name></package>",
        "src/b/package.xml": b"<package><name>pkg</name></package>",
        "models/crate/model.config": b"<model><name>Crate</name></model>",
        "package.xml": b"<package><name>top</name></package>",
        "src/c/package.xml": b"<package><name>broken",
        "src/d/notes.xml": b"<package><name>no</name></package>",
    }
    folders = package_folders(files)
    assert folders == {
        "pkg": ["src/a", "src/b"],
        "Crate": ["models/crate"],
        "crate": ["models/crate"],
        "top": [""],
    }
    assert nearest(folders["pkg"], "src/b/trees") == "src/b"
    assert nearest(folders["pkg"], "src") == "src/a"


@pytest.mark.parametrize(
    "data",
    [b"", b"<!DOCTYPE p [<!ENTITY a 'b'>]><package><name>&a;</name></package>", b"<sdf><name>x</name></sdf>"],
)
def test_what_is_no_manifest_has_no_name(data: bytes) -> None:
    assert manifest_name(data) is None


def test_a_file_that_a_build_would_install_elsewhere_is_found_where_it_lies(tmp_path: pathlib.Path) -> None:
    bot = package(tmp_path / "bot", "bot")
    (bot / "description" / "urdf").mkdir(parents=True)
    (bot / "description" / "urdf" / "a.xacro").touch()
    packages = searched(bot, tmp_path)
    assert packages.file("package://bot/urdf/a.xacro").samefile(bot / "description" / "urdf" / "a.xacro")
    assert packages.notes == ["urdf/a.xacro is description/urdf/a.xacro in bot of the project"]
    (bot / "other" / "urdf").mkdir(parents=True)
    (bot / "other" / "urdf" / "a.xacro").touch()
    assert not packages.file("package://bot/urdf/a.xacro").exists()  # two: it is not clear which
