"""Builds packages for BehaviorTree.CPP with a real one, and compares what their plugins say of themselves.

    python -m tests.tools.cpp_build FOLDER BTCPP LIBRARY [--write]

BTCPP is a checkout of BehaviorTree.CPP 4, LIBRARY the folder with its `libbehaviortree_cpp.so`, FOLDER takes
what is built. The packages are those of the examples and of the hostile project of the tests. Each plugin is
compiled with all warnings as errors, and loaded; its `TreeNodesModel` must be that of the package, and its
tree must load. `--write` stores what the hostile plugin writes as a fixture of the tests.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.translator.cpp.hostile import hostile_project
from translator import CppPackage, open_path, take_over, to_cpp_package
from translator.xml.read import read_document

if TYPE_CHECKING:
    from translator import Project

ROOT: Final = Path(__file__).resolve().parents[2]
FIXTURE: Final = ROOT / "tests" / "translator" / "cpp" / "models_4_10.xml"
WARNINGS: Final = ("-std=c++17", "-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter")
PROGRAM: Final = """
#include <iostream>
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/xml_parsing.h"
int main(int, char** argv)
{
  BT::BehaviorTreeFactory factory;
  factory.registerFromPlugin(argv[1]);
  std::cout << BT::writeTreeNodesModelXML(factory);
  auto tree = factory.createTreeFromFile(argv[2]);
  std::cerr << BT::toStr(tree.tickExactlyOnce()) << std::endl;
}
"""


def build(folder: Path, package: CppPackage, btcpp: Path, library: Path) -> bytes:
    """Compiles and loads a package's plugin, and returns the models that it writes."""
    for path, raw in package.files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(raw)
    own = folder / package.name
    plugin = own / "plugin.so"
    common = ("nice", "g++", "-isystem", str(btcpp / "include"), f"-I{own / 'include'}")
    sources = [str(own / path) for path in ("src/register_nodes.cpp", "unity.cpp")]
    nodes = sorted(path.relative_to(own) for path in (own / "src" / "nodes").glob("*.cpp"))
    # One unit, which is quicker, and finds names that clash.
    (own / "unity.cpp").write_text("".join(f'#include "{path}"\n' for path in nodes))
    subprocess.run(
        [*common, *WARNINGS, "-DBT_PLUGIN_EXPORT", "-fPIC", "-shared", *sources, "-o", str(plugin)],
        check=True,
    )
    program = folder / "program"
    links = [f"-L{library}", "-lbehaviortree_cpp", f"-Wl,-rpath,{library}"]
    if not program.exists():
        (folder / "program.cpp").write_text(PROGRAM)
        subprocess.run([*common, str(folder / "program.cpp"), *links, "-o", str(program)], check=True)
    tree = own / "trees" / f"{package.name}.xml"
    return subprocess.run([program, plugin, tree], check=True, stdout=subprocess.PIPE).stdout


def differences(project: Project, package: CppPackage, written: bytes) -> list[str]:
    """Returns where a plugin's models differ from those of its package, and from the project."""
    ours = read_document(package.files[f"{package.name}/models/{package.name}.xml"], file="ours").models
    theirs = read_document(written, file="theirs").models
    found = [f"{name}: {ours.get(name)} / {theirs.get(name)}" for name in ours if name not in theirs]
    for name, model in theirs.items():
        if name not in ours or dict(ours[name].ports) != dict(model.ports):
            found.append(f"{name}: {ours.get(name)} / {model}")
    kept = take_over(project, written)
    return found + [*kept.files] + [str(item) for item in kept.diagnostics if item.code != "BT0748"]


def main() -> None:
    """Builds all packages; the exit status is 1 if something differs."""
    folder, btcpp, library = (Path(text).resolve() for text in sys.argv[1:4])
    failed = False
    projects = [hostile_project(), *(open_path(path) for path in sorted((ROOT / "examples").iterdir()))]
    for number, project in enumerate(projects):
        package = to_cpp_package(project)
        written = build(folder, package, btcpp, library)
        found = differences(project, package, written)
        print(package.name, found or "agrees", flush=True)
        failed = failed or bool(found)
        if number == 0 and "--write" in sys.argv:
            FIXTURE.write_bytes(written)
    sys.exit(failed)


if __name__ == "__main__":
    main()
