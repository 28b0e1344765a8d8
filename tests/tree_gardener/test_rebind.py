"""Classes written for ``py_trees.ports``, which py_trees has since 2.5."""

from __future__ import annotations

from typing import ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus
from py_trees.ports import PortInformation, PortsMixin

from tests.tree_gardener.trees import load
from tree_gardener import PortError, Status
from tree_gardener.rebind import rebind


class WithMixin(PortsMixin, py_trees.behaviour.Behaviour):
    INPUT_PORTS: ClassVar = {"x": PortInformation(data_type=float, default_value=2.0)}
    OUTPUT_PORTS: ClassVar = {"y": PortInformation(data_type=float)}

    def update(self) -> PyTreesStatus:
        self._set_output("y", self.get_input("x") * 2)
        return PyTreesStatus.SUCCESS


def test_classes_on_py_trees_ports_are_rebound() -> None:
    tree = load('<Double y="{y}"/>', nodes={"Double": WithMixin})
    assert tree.tick_once() is Status.SUCCESS
    assert tree.blackboard["y"] == 4.0
    behaviour = tree.nodes[0].behaviour
    assert behaviour.get_input("none", default=7) == 7
    with pytest.raises(PortError):
        behaviour.get_input("none")


def test_a_behaviour_without_py_trees_ports_stays_as_it_is() -> None:
    behaviour = py_trees.behaviours.Success("s")
    before = dict(vars(behaviour))
    rebind(behaviour)
    assert vars(behaviour) == before
