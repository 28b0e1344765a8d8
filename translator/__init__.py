"""From diagrams to BehaviorTree.CPP XML and ROS 2 packages, and back: pure functions, no ROS, no Django."""

from translator.action import ActionModel, inspect_action
from translator.check import check
from translator.diagnostic import Diagnostic, Place, Severity, TranslatorError
from translator.export import export_files, self_contained, to_xml
from translator.importer import from_xml
from translator.package.app import to_app_zip
from translator.project import Project, load
from translator.settings import Settings
from translator.tree import Node, Tree

__all__ = [
    "ActionModel",
    "Diagnostic",
    "Node",
    "Place",
    "Project",
    "Settings",
    "Severity",
    "TranslatorError",
    "Tree",
    "check",
    "export_files",
    "from_xml",
    "inspect_action",
    "load",
    "self_contained",
    "to_app_zip",
    "to_xml",
]
