"""Stops a tree at its nodes, and forces their results.

* `agent` is what the engine expects of a debugger; `wiring` makes the nodes ask it.
* `breakpoints` says where to stop, `stepper` where a step ends, `places` names nodes that are renamed.
* `forces` holds the results that users force on nodes.
* `ahead` tells what the rules may still tick in the tick.
* `debugger` is the agent that puts these together.

```python
debugger = Debugger(hold=serve)
tree.debug(debugger)
debugger.set_breakpoints([Breakpoint(place_of(node))])
```

`serve(stop)` runs on the ticking thread while the tree is held, and calls the debugger's commands; the
tree continues when it returns.
"""

from tree_gardener.debugging.agent import DebuggingEnded
from tree_gardener.debugging.breakpoints import Breakpoint, BreakpointError, When
from tree_gardener.debugging.debugger import Debugger
from tree_gardener.debugging.forces import Force, ForceError, Position
from tree_gardener.debugging.places import Place, nodes_at, place_of
from tree_gardener.debugging.stepper import Event, Step
from tree_gardener.debugging.stop import Stop

__all__ = [
    "Breakpoint",
    "BreakpointError",
    "Debugger",
    "DebuggingEnded",
    "Event",
    "Force",
    "ForceError",
    "Place",
    "Position",
    "Step",
    "Stop",
    "When",
    "nodes_at",
    "place_of",
]
