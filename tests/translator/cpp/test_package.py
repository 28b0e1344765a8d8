"""The package for BehaviorTree.CPP as files; `tests.tools.cpp_build` compiles it."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path

import pytest
from catkin_pkg.package import parse_package
from lxml import etree

from tests.translator.cpp.hostile import hostile_project
from translator import TranslatorError, to_cpp_package
from translator.cpp.nodes import cpp_nodes
from translator.cpp.package import models_xml
from translator.xml.read import read_document

WRITTEN = (Path(__file__).parent / "models_4_10.xml").read_bytes()
"""What the plugin of the hostile project writes with BehaviorTree.CPP 4.10."""


def test_examples_are_valid_packages(example, tmp_path) -> None:
    package = to_cpp_package(example)
    assert package.diagnostics == ()
    path = tmp_path / "package.xml"
    path.write_bytes(package.files[f"{package.name}/package.xml"])
    found = parse_package(str(path), warnings=[])
    found.validate()
    assert found.name == package.name
    assert found.get_build_type() == "ament_cmake"
    assert "behaviortree_cpp" in {item.name for item in found.build_depends}
    cmake = package.files[f"{package.name}/CMakeLists.txt"].decode()
    sources = {path for path in package.files if path.endswith(".cpp") and "run_tree" not in path}
    assert {f"{package.name}/{path}" for path in re.findall(r"src/\S+?\.cpp", cmake)} - sources == {
        f"{package.name}/src/run_tree.cpp"
    }
    assert "BT_PLUGIN_EXPORT" in cmake
    assert b"<BehaviorTree" in package.files[f"{package.name}/trees/{package.name}.xml"]


def test_a_plain_install_which_states_no_version_is_found(example) -> None:
    package = to_cpp_package(example)
    cmake = package.files[f"{package.name}/CMakeLists.txt"].decode()
    assert re.findall(r"find_package\(behaviortree_cpp\b([^)]*)\)", cmake) == [" REQUIRED"]
    version = re.search(r'NOT behaviortree_cpp_VERSION MATCHES "(.*)"', cmake)
    assert version is not None
    pattern = version[1].replace("\\\\", "\\")  # as CMake reads it
    assert [bool(re.match(pattern, each)) for each in ("4.6.1", "4.10.0", "3.8.6", "40.1", "5.0")] == [
        *(True, True, False, False, False)
    ]


def test_a_node_is_a_class_with_its_docstring(example) -> None:
    package = to_cpp_package(example)
    register = package.files[f"{package.name}/src/register_nodes.cpp"].decode()
    for node in cpp_nodes(example, set()):
        header = package.files[f"{package.name}/include/{package.name}/nodes/{node.file}.hpp"].decode()
        assert f"class {node.class_name} : public BT::{node.base}" in header
        assert node.doc.splitlines()[0] in header
        assert f'factory.registerNodeType<{package.name}::{node.class_name}>("{node.id}");' in register


def test_the_same_project_gives_the_same_bytes() -> None:
    zipped = to_cpp_package(hostile_project()).to_zip()
    assert zipped == to_cpp_package(hostile_project()).to_zip()
    with zipfile.ZipFile(io.BytesIO(zipped)) as archive:
        assert all(name.isascii() for name in archive.namelist())


def test_texts_stay_in_their_comments_and_literals() -> None:
    package = to_cpp_package(hostile_project())
    for path, raw in package.files.items():
        if path.endswith((".hpp", ".cpp")):
            code = re.sub(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', "", raw.decode(), flags=re.DOTALL)
            assert not re.search(r"injected|\bsystem\b|nothing|\?\?|[^\x00-\x7f]|\*/", code), path
            assert "\u202e" not in raw.decode()
    etree.fromstring(package.files[f"{package.name}/package.xml"])


def test_the_models_are_those_that_behaviortree_cpp_writes() -> None:
    package = to_cpp_package(hostile_project())
    ours = read_document(package.files[f"{package.name}/models/{package.name}.xml"], file="ours").models
    theirs = read_document(WRITTEN, file="theirs").models
    assert ours.keys() == theirs.keys()
    assert len(ours["switch"].ports) == 21
    for name, model in ours.items():
        assert dict(model.ports) == dict(theirs[name].ports), name
        assert model.kind == theirs[name].kind


def test_a_name_is_chosen_or_refused() -> None:
    assert to_cpp_package(hostile_project(), name="my_robot").name == "my_robot"
    # A package may have the name of a keyword of C++, a namespace may not.
    made = to_cpp_package(hostile_project(), name="switch")
    assert b"namespace switch_\n" in made.files["switch/include/switch/enums.hpp"]
    with pytest.raises(TranslatorError, match="BT0900"):
        to_cpp_package(hostile_project(), name="My Robot")


def test_a_project_without_nodes_and_with_blocks_of_ros(make_project) -> None:
    ports = {"service_name": "/enable", "service_type": "std_srvs/srv/SetBool"}
    project = make_project({"n1": {"type": "RosService", "name": "a\\", "ports": ports}}, LICENSE=None)
    package = to_cpp_package(project)
    register = package.files[f"{package.name}/src/register_nodes.cpp"].decode()
    assert '//   RosService "a\\\\" in the tree "MainTree", of "std_srvs/srv/SetBool"' in register
    assert "## Blocks of ROS" in package.files[f"{package.name}/README.md"].decode()


def test_a_broken_project_is_refused(make_project) -> None:
    with pytest.raises(TranslatorError, match="BT0102"):
        to_cpp_package(make_project({"n1": {"type": "Nowhere"}}))


def test_no_nodes_give_an_empty_palette() -> None:
    assert models_xml([]).count("<") == 4
