"""The package for BehaviorTree.CPP 4: an ament package with the trees and a plugin of node skeletons."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

import jinja2

from translator.cpp.names import comment_lines, identifier, literal, one_line
from translator.cpp.nodes import ANY, CppNode, cpp_enums, cpp_nodes, ros_blocks
from translator.export import require_sound, to_xml
from translator.package.naming import package_name, require_maintainer, require_name
from translator.package.ros2 import render as render_ros2
from translator.package.zip import write_zip
from translator.text import clean
from translator.xml.write import EXPLICIT_TAGS, model_element

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from translator.diagnostic import Diagnostic
    from translator.project import Project

SUFFIX = "_cpp"
VERSION = "0.1.0"


@dataclass(frozen=True, slots=True)
class CppPackage:
    """A package ready to be written: its name, its files by path, and findings for the user."""

    name: str
    files: Mapping[str, bytes]
    diagnostics: tuple[Diagnostic, ...] = ()

    def to_zip(self) -> bytes:
        """Returns the zip; the same package gives the same bytes."""
        return write_zip(self.files)


def to_cpp_package(project: Project, *, name: str | None = None) -> CppPackage:
    """Returns the project as a package for BehaviorTree.CPP 4, with a skeleton of each of its own nodes.

    Args:
        project: The project.
        name: The package's name; made from the project's name if not given.

    Raises:
        TranslatorError: If the project has errors, or the name is not valid for a ROS package.
    """
    require_sound(project, elsewhere=True)
    require_maintainer(project.settings)
    chosen = require_name(name) if name is not None else package_name(project.settings.name) + SUFFIX
    space = identifier(chosen)
    taken = {space}
    enums = cpp_enums(project, taken)
    nodes = cpp_nodes(project, taken, enums)
    settings = project.settings
    values: dict[str, object] = {
        "name": chosen,
        "space": space,
        "title": settings.name,
        "version": VERSION,
        "description": " ".join(settings.description.split()) or settings.name,
        "license": settings.license,
        "maintainer": settings.maintainer.name or "Unnamed",
        "email": settings.maintainer.email or "nobody@example.org",
        "nodes": nodes,
        "enums": enums,
        "blocks": ros_blocks(project),
        "period_ms": max(1, round(1000 / settings.tick_hz)),
        "any": ANY,
    }
    include, sources = f"{chosen}/include/{chosen}", f"{chosen}/src"
    rows = [
        ("package.xml", f"{chosen}/package.xml"),
        ("CMakeLists.txt", f"{chosen}/CMakeLists.txt"),
        ("README.md", f"{chosen}/README.md"),
        ("register_nodes.cpp", f"{sources}/register_nodes.cpp"),
        ("run_tree.cpp", f"{sources}/run_tree.cpp"),
        *([("enums.hpp", f"{include}/enums.hpp")] if enums else []),
    ]
    files = {path: _render(template, **values) for template, path in rows}
    for node in nodes:
        files[f"{include}/nodes/{node.file}.hpp"] = _render("node.hpp", node=node, **values)
        files[f"{sources}/nodes/{node.file}.cpp"] = _render("node.cpp", node=node, **values)
    files[f"{chosen}/trees/{chosen}.xml"] = to_xml(project).encode()
    files[f"{chosen}/models/{chosen}.xml"] = models_xml(nodes).encode()
    own = project.files.get("LICENSE")
    files[f"{chosen}/LICENSE"] = own if own is not None else render_ros2("LICENSE", **values)
    return CppPackage(chosen, files, tuple(found for node in nodes for found in node.diagnostics()))


def models_xml(nodes: Iterable[CppNode]) -> str:
    """Returns the models of the nodes as the plugin declares them."""
    lines = ['<root BTCPP_format="4">', "    <TreeNodesModel>"]
    for node in nodes:
        ports = [port.model for port in node.ports]
        tag = EXPLICIT_TAGS.get(node.kind, "Action")
        lines += model_element(tag, node.id, ports, indent="    ", any_type=ANY)
    return "\n".join([*lines, "    </TreeNodesModel>", "</root>", ""])


@cache
def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("translator.cpp", "templates"),
        undefined=jinja2.StrictUndefined,
        autoescape=False,  # noqa: S701 - the templates are C++ and text; XML has a filter
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["literal"] = literal
    environment.filters["comment"] = lambda text: list(comment_lines(text))
    environment.filters["line"] = lambda text: one_line([str(text)])
    environment.filters["xml"] = lambda text: escape(clean(str(text)), {'"': "&quot;"})
    return environment


def _render(template: str, **values: object) -> bytes:
    return _environment().get_template(f"{template}.j2").render(**values).encode()
