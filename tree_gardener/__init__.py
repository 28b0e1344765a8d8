"""Behaviour trees with the semantics of BehaviorTree.CPP 4, on py_trees behaviours.

```python
from tree_gardener import Status, Tree

tree = Tree.from_xml(text, nodes={"Forward": Forward})
tree.setup(node=ros_node)
while tree.tick_once() is Status.RUNNING:
    ...
```
"""

from typing import TYPE_CHECKING

from tree_gardener.lazy import lazy_package

if TYPE_CHECKING:
    from tree_gardener.backup import backup, restore
    from tree_gardener.board_json import (
        blackboard_from_json,
        blackboard_to_json,
        tree_from_json,
        tree_to_json,
    )
    from tree_gardener.clock import ManualClock, SystemClock
    from tree_gardener.control_node import ControlNode, DecoratorNode, LoopNode
    from tree_gardener.errors import (
        Diagnostic,
        LoadError,
        PortError,
        PortRefusedError,
        ScriptError,
        TickError,
    )
    from tree_gardener.observe import BlackboardChange, TickChanges
    from tree_gardener.port_change import PortEffect, set_port
    from tree_gardener.ports import Port, get_input, set_output
    from tree_gardener.registered import register_type
    from tree_gardener.status import Status
    from tree_gardener.tree import Tree
    from tree_gardener.values import AnyTypeAllowed, SharedQueue

__version__ = "0.1.0"

__all__ = [
    "AnyTypeAllowed",
    "BlackboardChange",
    "ControlNode",
    "DecoratorNode",
    "Diagnostic",
    "LoadError",
    "LoopNode",
    "ManualClock",
    "Port",
    "PortEffect",
    "PortError",
    "PortRefusedError",
    "ScriptError",
    "SharedQueue",
    "Status",
    "SystemClock",
    "TickChanges",
    "TickError",
    "Tree",
    "__version__",
    "backup",
    "blackboard_from_json",
    "blackboard_to_json",
    "get_input",
    "register_type",
    "restore",
    "set_output",
    "set_port",
    "tree_from_json",
    "tree_to_json",
]

lazy_package(
    __name__,
    {
        "tree_gardener.backup": "backup restore",
        "tree_gardener.board_json": "blackboard_from_json blackboard_to_json tree_from_json tree_to_json",
        "tree_gardener.clock": "ManualClock SystemClock",
        "tree_gardener.control_node": "ControlNode DecoratorNode LoopNode",
        "tree_gardener.errors": "Diagnostic LoadError PortError PortRefusedError ScriptError TickError",
        "tree_gardener.observe": "BlackboardChange TickChanges",
        "tree_gardener.port_change": "PortEffect set_port",
        "tree_gardener.ports": "Port get_input set_output",
        "tree_gardener.registered": "register_type",
        "tree_gardener.status": "Status",
        "tree_gardener.tree": "Tree",
        "tree_gardener.values": "AnyTypeAllowed SharedQueue",
    },
)
