"""Imports that nothing has, and names that a module does not have."""

from __future__ import annotations

import ast

import pytest

from tests.translator.check.sources.cases import BASE, FIRST, UPDATE, found_in
from translator.check.sources.imports import Imports
from translator.check.sources.modules import Modules
from translator.check.sources.scopes import Scopes

HELPER = {"actions/helper.py": b"def twice(x):\n    return 2 * x\n", "tools/deep.py": b""}


@pytest.mark.parametrize(
    ("head", "code", "severity"),
    [
        ("import no_such_package", "BT0642", "error"),
        ("from no_such_package.inner import x", "BT0642", "error"),
        ("import py_trees.no_such_module", "BT0642", "error"),
        ("from actions.missing import x", "BT0621", "error"),
        ("from . import missing", "BT0621", "error"),
        ("from .missing import x", "BT0621", "error"),
        ("from ..helper import twice", "BT0642", "error"),
        ("from actions.helper import treble", "BT0643", "error"),
        ("from helper import treble", "BT0643", "error"),
        ("from py_trees.common import Statuss", "BT0643", "error"),
        ("from tree_gardener import Prt", "BT0643", "error"),
        ("from geometry_msgs.msg import Twists", "BT0643", "error"),
        ("X = py_trees.comon", "BT0643", "error"),
        ("import serial", "BT0644", "warning"),
        ("import nav2_simple_commander.robot_navigator", "BT0644", "warning"),
        ("import sys; sys.path.append('x'); import no_such_package", "BT0642", "warning"),
        ("def f():\n    import no_such_package", "BT0642", "warning"),
        ("def f():\n    from actions.missing import x", "BT0621", "warning"),
    ],
)
def test_an_import_that_finds_nothing(head: str, code: str, severity: str) -> None:
    source = f"import py_trees\n{head}\n{BASE}{UPDATE}"
    found = found_in(source, HELPER)
    assert [each[:2] for each in found] == [(code, severity)]
    assert found[0][2] in {2, 3}


@pytest.mark.parametrize(
    "head",
    [
        "try:\n    import no_such_package\nexcept ImportError:\n    no_such_package = None",
        "try:\n    from actions.missing import x\nexcept ImportError:\n    x = None",
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from no_such_package import x",
        "import typing\nif typing.TYPE_CHECKING:\n    from actions.missing import x",
        "from helper import twice",
        "import helper, actions.helper\nX = helper.twice(actions.helper.twice(2))",
        "from actions import helper",
        "from tools import deep\nimport tools.deep",
        "import os.path, xml.dom.minidom, collections.abc, importlib.metadata",
        "import numpy as np, cv2, rclpy.qos\nX = np.float64(1), cv2.__version__",
        "import geometry_msgs\nX = geometry_msgs.msg.Twist",
        "from tf2_ros import Buffer\nfrom cv_bridge import CvBridge\nimport tree_tools",
        "from tree_gardener import Port, get_input\nfrom tree_gardener.ports import Port",
    ],
)
def test_an_import_that_is_found_or_may_be(head: str) -> None:
    assert found_in(f"{head}\n{BASE}{UPDATE}", HELPER) == []


def test_packages_that_the_project_lists_are_no_errors() -> None:
    source = f"import no_such_package\nimport other_package\n{BASE}{UPDATE}"
    listed = {"requirements.txt": b"no-such_Package>=1.0\n# comment\n"}
    assert found_in(source, listed) == [("BT0644", "warning", 1), ("BT0642", "warning", 2)]
    manifest = {"package.xml": b"<package><exec_depend>no_such_package</exec_depend></package>"}
    assert ("BT0644", "warning", 1) in found_in(source, manifest)


@pytest.mark.parametrize("name", ["py_trees.common.Status.SUCCES", "Status.SUCCES", "py_trees.Blackbord"])
def test_an_attribute_that_a_module_or_an_enumeration_does_not_have(name: str) -> None:
    source = f"{BASE}    def update(self):\n        return {name}\n"
    assert found_in(source) == [("BT0643", "warning", FIRST + 1)]


@pytest.mark.parametrize(
    "body",
    [
        "return py_trees.common.Status.SUCCESS.value and Status.__members__ and Status.SUCCESS",
        "return py_trees.made if hasattr(py_trees, 'made') else Status.SUCCESS",
        "py_trees.made = 1\n        return py_trees.made",
        "try:\n            return py_trees.made\n"
        "        except AttributeError:\n            return Status.SUCCESS",
        "py_trees = self\n        return py_trees.made",
    ],
)
def test_an_attribute_that_may_be_there(body: str) -> None:
    assert found_in(f"{BASE}    def update(self):\n        {body}\n") == []


def test_each_attribute_is_reported_once() -> None:
    scopes = Scopes(ast.parse("import py_trees\nX = py_trees.comon, py_trees.comon, py_trees.trees"))
    found = list(Imports(scopes, Modules({}), has_project=True).findings())
    assert [(each.code, each.values["name"]) for each in found] == [("BT0643", "comon")]
