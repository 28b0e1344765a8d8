"""Translates diagrams to BehaviorTree.CPP XML and ROS 2 packages, and back, without ROS and Django."""

from typing import TYPE_CHECKING

from tree_gardener.lazy import lazy_package

if TYPE_CHECKING:
    from translator.action import ActionModel, inspect_action
    from translator.check import check
    from translator.cpp.package import CppPackage, to_cpp_package
    from translator.cpp.sync import InStep, take_over
    from translator.diagnostic import Diagnostic, Place, Severity, TranslatorError
    from translator.export import export_files, self_contained, to_xml
    from translator.importer import from_xml
    from translator.opening import open_files, open_path
    from translator.package.app import to_app_zip
    from translator.package.ros2 import Ros2Package, to_ros2_package
    from translator.project import Project, load
    from translator.settings import Settings
    from translator.tree import Node, Tree
    from translator.xml.models import to_models_xml, to_xsd

__all__ = [
    "ActionModel",
    "CppPackage",
    "Diagnostic",
    "InStep",
    "Node",
    "Place",
    "Project",
    "Ros2Package",
    "Settings",
    "Severity",
    "TranslatorError",
    "Tree",
    "check",
    "export_files",
    "from_xml",
    "inspect_action",
    "load",
    "open_files",
    "open_path",
    "self_contained",
    "take_over",
    "to_app_zip",
    "to_cpp_package",
    "to_models_xml",
    "to_ros2_package",
    "to_xml",
    "to_xsd",
]

lazy_package(
    __name__,
    {
        "translator.action": "ActionModel inspect_action",
        "translator.check": "check",
        "translator.cpp.package": "CppPackage to_cpp_package",
        "translator.cpp.sync": "InStep take_over",
        "translator.diagnostic": "Diagnostic Place Severity TranslatorError",
        "translator.export": "export_files self_contained to_xml",
        "translator.importer": "from_xml",
        "translator.opening": "open_files open_path",
        "translator.package.app": "to_app_zip",
        "translator.package.ros2": "Ros2Package to_ros2_package",
        "translator.project": "Project load",
        "translator.settings": "Settings",
        "translator.tree": "Node Tree",
        "translator.xml.models": "to_models_xml to_xsd",
    },
)
