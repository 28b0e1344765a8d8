"""SkipUnlessUpdated and WaitValueUpdate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.trees import letters, load
from tree_gardener.decorators.update import SkipUnlessUpdated, WaitValueUpdate

if TYPE_CHECKING:
    from tree_gardener.node import Decorator


@pytest.mark.parametrize(("kind", "otherwise"), [(SkipUnlessUpdated, "K"), (WaitValueUpdate, "R")])
def test_the_child_is_ticked_after_each_write(kind: type[Decorator], otherwise: str) -> None:
    name = kind.__name__
    tree = load(f"<{name} entry='{{x}}'><Succeeding/></{name}>")
    assert letters(tree, 1) == otherwise
    tree.blackboard["x"] = 1
    assert letters(tree, 2) == "S" + otherwise
    tree.blackboard["x"] = 1
    assert letters(tree, 1) == "S"
