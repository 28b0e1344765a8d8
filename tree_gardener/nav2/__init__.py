"""Control nodes and decorators of Nav2, written with the public classes for control nodes.

Each module is complete in itself, so that its source can also be a project's ``actions/<Name>.py``, and it
travels in exported packages with the engine. ``Tree.from_xml(text, nodes=NODES)`` runs trees that use them.
The tests compare them with Nav2's own C++ in BehaviorTree.CPP 4.10.
"""

from collections.abc import Mapping
from typing import Final

from tree_gardener.control_node import ControlNode
from tree_gardener.nav2.nonblocking_sequence import NonblockingSequence
from tree_gardener.nav2.persistent_sequence import PersistentSequence
from tree_gardener.nav2.pipeline_sequence import PipelineSequence
from tree_gardener.nav2.rate_controller import RateController
from tree_gardener.nav2.recovery_node import RecoveryNode
from tree_gardener.nav2.round_robin import RoundRobin

NODES: Final[Mapping[str, type[ControlNode]]] = {
    cls.__name__: cls
    for cls in (
        *(NonblockingSequence, PersistentSequence, PipelineSequence, RateController),
        *(RecoveryNode, RoundRobin),
    )
}
