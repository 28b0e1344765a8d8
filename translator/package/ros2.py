"""The ROS 2 package: all files that a colcon workspace needs to build and run the project."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import PurePosixPath
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

import jinja2

from translator.action import inspect_action
from translator.behaviour_tests import paths_of_tests, to_job
from translator.endpoints import Endpoint, endpoints
from translator.export import require_sound, write_self_contained
from translator.nav2.models import distribution_for
from translator.package.app import is_action_source
from translator.package.engine import engine_files
from translator.package.interfaces import (
    absolute_names,
    example_name,
    interface_rows,
    parameter_rows,
    unknown_names,
)
from translator.package.launch_files import (
    FOLDER,
    as_program,
    companions,
    dependencies_of,
    in_package,
    launch_files,
    programs,
    started_files,
)
from translator.package.literal import python_literal
from translator.package.naming import package_name, require_maintainer, require_name
from translator.package.rosdep import dependencies
from translator.package.zip import write_zip
from translator.ros_nodes import ros_endpoints, ros_packages

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from translator.diagnostic import Diagnostic
    from translator.project import Project

ENGINE = "tree_gardener"
ENGINE_DEPENDENCIES = ("py_trees", "python3-lxml", "rcl_interfaces", "rclpy")
VERSION = "0.1.0"
_VERSION = re.compile(rb'^__version__(?::[^=]+)? = "([^"]+)"', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Ros2Package:
    """A package ready to be written: its name, its files by path, and findings for the user."""

    name: str
    files: Mapping[str, bytes]
    diagnostics: tuple[Diagnostic, ...] = ()

    def to_zip(self) -> bytes:
        """Returns the zip; the same package gives the same bytes."""
        return write_zip(self.files)


def to_ros2_package(project: Project, *, name: str | None = None) -> Ros2Package:
    """Returns the project as a ROS 2 package, with the engine as a second package beside it.

    Args:
        project: The project.
        name: The package's name; made from the project's name if not given.

    Raises:
        TranslatorError: If the project has errors, or the name is not valid for a ROS package.
    """
    require_sound(project, elsewhere=True)
    require_maintainer(project.settings)
    chosen = require_name(name) if name is not None else package_name(project.settings.name)
    builder = _Builder(project, chosen)
    return Ros2Package(chosen, builder.files(), tuple(builder.found))


class _Builder:
    """Makes the files of one package."""

    def __init__(self, project: Project, name: str) -> None:
        self.project = project
        self.name = name
        self.found: list[Diagnostic] = []
        self.sources = {path: raw for path, raw in sorted(project.files.items()) if is_action_source(path)}
        self.launch_files = launch_files(project.files)
        self.programs = programs(project.files)
        self.companions = companions(project.files)

    def files(self) -> dict[str, bytes]:
        inner = f"{self.name}/{self.name}"
        files = {
            f"{self.name}/resource/{self.name}": b"",
            f"{self.name}/trees/{self.name}.xml": write_self_contained(self.project).encode(),
            f"{inner}/__init__.py": b"",
            **{f"{inner}/{path}": raw for path, raw in self.sources.items()},
            **self.extras(),
        }
        for folder in self.packages():
            files.setdefault(f"{self.name}/{folder}/__init__.py", b"")
        values = self.values()
        for template, path in (
            ("package.xml", f"{self.name}/package.xml"),
            ("setup.py", f"{self.name}/setup.py"),
            ("setup.cfg", f"{self.name}/setup.cfg"),
            ("README.md", f"{self.name}/README.md"),
            ("LICENSE", f"{self.name}/LICENSE"),
            ("main.py", f"{inner}/main.py"),
            ("launch.py", f"{self.name}/launch/{self.name}.launch.py"),
            ("params.yaml", f"{self.name}/config/params.yaml"),
        ):
            files[path] = render(template, **values)
        if paths_of_tests(self.project.files):
            job = to_job(self.project)[0]
            document = {**job, "xml": ""}  # the trees are in the package
            text = json.dumps(document, ensure_ascii=False, indent=1) + "\n"
            files[f"{self.name}/test/behaviour_tests.json"] = text.encode()
            files[f"{self.name}/test/test_behaviours.py"] = render("test_behaviours.py", name=self.name)
            files[f".github/workflows/{self.name}.yml"] = render("workflow.yml", **values)
        if "LICENSE" in self.project.files:
            files[f"{self.name}/LICENSE"] = self.project.files["LICENSE"]
        return {**files, **engine_package()}

    def extras(self) -> dict[str, bytes]:
        """Returns launch files, assets and requirements of the project."""
        result = {
            f"{self.name}/scripts/{name}": as_program(self.project.files[path])
            for path, name in self.programs.items()
        }
        for path, raw in self.project.files.items():
            if path in self.launch_files:
                text, found = in_package(path, raw, self.name, self.programs)
                result[f"{self.name}/launch/{self.own_launch_name(path)}"] = text
                self.found.extend(found)
            elif path.startswith("assets/") or path in (*self.companions, "requirements.txt"):
                result[f"{self.name}/{path}"] = raw
        return result

    def own_launch_name(self, path: str) -> str:
        """Returns the path below `launch` for a launch file of the project.

        It differs from the package's own.
        """
        name = path.removeprefix(FOLDER)
        return f"project_{name}" if name == f"{self.name}.launch.py" else name

    def packages(self) -> list[str]:
        """Returns the Python packages: the package itself, and each folder of actions."""
        folders = {PurePosixPath(path).parent for path in self.sources} | {PurePosixPath("actions")}
        folders |= {parent for folder in folders for parent in folder.parents if parent.parts}
        return [self.name, *(f"{self.name}/{folder}" for folder in sorted(folders))]

    def values(self) -> dict[str, object]:
        """Returns the values of the templates."""
        settings = self.project.settings
        project_files = dict(sorted(self.project.files.items()))
        models = [
            inspect_action(raw.decode("utf-8-sig", "replace"), path)
            for path, raw in project_files.items()
            if path.endswith(".py") and path in {*self.sources, *self.programs, *self.launch_files}
        ]
        own = {PurePosixPath(path).parts[1].removesuffix(".py") for path in self.sources}
        keys, found = dependencies(models, own)
        self.found.extend(found)
        own_launch = [self.own_launch_name(path) for path in self.launch_files]
        started = [self.own_launch_name(path) for path in started_files(self.project.files)]
        always = {"ament_index_python", "launch", "launch_ros", *ENGINE_DEPENDENCIES, ENGINE}
        always |= dependencies_of(project_files) | ros_packages(self.project.trees.values())
        opened = self.endpoints()
        return {
            "name": self.name,
            "title": settings.name,
            "version": VERSION,
            "description": " ".join(settings.description.split()) or settings.name,
            "license": settings.license,
            "distribution": distribution_for(self.project),
            "maintainer": settings.maintainer.name or "Unnamed",
            "email": settings.maintainer.email or "nobody@example.org",
            "dependencies": sorted(always | set(keys)),
            "packages": [folder.replace("/", ".") for folder in self.packages()],
            "data_files": list(self.data_files(own_launch)),
            "own_launch": started,
            "absolute_names": absolute_names(opened),
            "interfaces": interface_rows(opened),
            "example_name": example_name(opened),
            "unknown_names": unknown_names(opened),
            "action_parameters": parameter_rows(opened),
            "programs": sorted(self.programs.values()),
            "scripts": [f"scripts/{name}" for name in self.programs.values()],
            "tick_hz": float(settings.tick_hz),
            "on_finish": settings.on_finish,
            "on_error": settings.on_error,
            "engine_version": engine_version(),
            "has_requirements": "requirements.txt" in self.project.files,
            "actions": sorted(self.project.actions),
            "has_tests": bool(paths_of_tests(self.project.files)),
        }

    def endpoints(self) -> list[Endpoint]:
        """Returns the endpoints of the trees, the actions and the programs, in order of file and line."""
        paths = {path: path for path in self.sources} | {
            path: f"scripts/{name}" for path, name in self.programs.items()
        }
        opened = [
            item
            for path, shown in paths.items()
            for item in endpoints(self.project.files[path].decode("utf-8-sig", "replace"), shown)
        ]
        return [*ros_endpoints(self.project.trees.values()), *opened]

    def data_files(self, own_launch: list[str]) -> Iterator[tuple[str, list[str]]]:
        """Yields the files to install below `share`, by folder."""
        share = f"share/{self.name}"
        yield "share/ament_index/resource_index/packages", [f"resource/{self.name}"]
        extra = ["requirements.txt"] if "requirements.txt" in self.project.files else []
        yield share, ["package.xml", *extra]
        yield f"{share}/trees", [f"trees/{self.name}.xml"]
        yield f"{share}/config", ["config/params.yaml"]
        paths = [f"{FOLDER}{name}" for name in (f"{self.name}.launch.py", *own_launch)]
        paths += [*self.companions, *sorted(p for p in self.project.files if p.startswith("assets/"))]
        folders: dict[str, list[str]] = {}
        for path in paths:
            folders.setdefault(str(PurePosixPath(path).parent), []).append(path)
        for folder, held in folders.items():
            yield f"{share}/{folder}", held


@cache
def engine_package() -> Mapping[str, bytes]:
    """Returns the engine as an ament_python package, by path."""
    files = {f"{ENGINE}/{path}": raw for path, raw in engine_files().items()}
    folders = {PurePosixPath(path).parent for path in engine_files() if path.endswith(".py")}
    values = {
        "version": engine_version(),
        "packages": [".".join(folder.parts) for folder in sorted(folders)],
        "data": sorted({f"*{PurePosixPath(path).suffix}" for path in engine_files()} - {"*.py"}),
        "dependencies": sorted(ENGINE_DEPENDENCIES),
    }
    for template in ("package.xml", "setup.py", "setup.cfg", "README.md"):
        files[f"{ENGINE}/{template}"] = render(f"engine_{template}", **values)
    files[f"{ENGINE}/LICENSE"] = render("LICENSE", license="Apache-2.0", maintainer="BT Studio")
    files[f"{ENGINE}/resource/{ENGINE}"] = b""
    return files


@cache
def engine_version() -> str:
    """Returns the version of the engine, read from its source."""
    found = _VERSION.search(engine_files()[f"{ENGINE}/__init__.py"])
    assert found is not None  # noqa: S101 - a test holds the engine to it
    return found.group(1).decode()


@cache
def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("translator.package", "templates"),
        undefined=jinja2.StrictUndefined,
        autoescape=False,  # noqa: S701 - the templates are Python, YAML and text; XML has a filter
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["python"] = python_literal
    environment.filters["xml"] = lambda text: escape(str(text), {'"': "&quot;"})
    environment.filters["yaml"] = _yaml_text
    return environment


def _yaml_text(value: object) -> str:
    return '"' + str(value).replace("\\", "\\\\").replace('"', '\\"') + '"'


def render(template: str, **values: object) -> bytes:
    """Returns a template of this package filled with values."""
    return _environment().get_template(f"{template}.j2").render(**values).encode()


def templates_folder() -> str:
    """Returns the folder of the templates, for tests that read all of them."""
    return str(resources.files("translator.package").joinpath("templates"))
