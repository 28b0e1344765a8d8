"""The translator on trees of 10 to 10,000 nodes: time and memory; the cost of a node must not grow.

Run alone with `python -m tests.benchmarks translator`.
"""

from __future__ import annotations

import time
import tracemalloc
from typing import TYPE_CHECKING

from translator import Node, Settings, Tree, check, from_xml, load, self_contained, to_ros2_package, to_xml
from translator.check.context import Context
from translator.check.effect import check_effects
from translator.check.endless import check_endless_loops
from translator.check.order import check_order
from translator.check.reach import check_reachability
from translator.check.together import check_together
from translator.importer import project_files

if TYPE_CHECKING:
    from collections.abc import Callable

SIZES = (10, 100, 1_000, 10_000)
TARGET_S = {"translate and check": 1.0, "package": 2.0, "import": 2.0}
TARGET_US_A_NODE = {"know without running": 30}
KNOWING = (
    check_order,
    check_reachability,
    check_effects,
    check_endless_loops,
    check_together,
)
WIDTH = 10
REPEATS = 3
SOURCE = """
import py_trees
from tree_gardener.ports import Port


class Forward(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"speed": Port(float, default=0.5)}

    def update(self):
        return py_trees.common.Status.SUCCESS
"""


def made_tree(size: int) -> Tree:
    """A tree of `size` nodes, ten children a control node, with ports, scripts and positions."""
    nodes: dict[str, Node] = {}
    for number in range(size):
        first = number * WIDTH + 1
        children = tuple(f"n{child}" for child in range(first, min(first + WIDTH, size)))
        position = (float(number % 97), float(number // 97))
        node_id = f"n{number}"
        if children:
            type_ = ("Sequence", "Fallback", "Parallel")[number % 3]
            nodes[node_id] = Node(
                node_id, type_, name=f"group {number}", children=children, position=position
            )
        elif number % 2:
            ports = {"speed": "{speed}"}
            nodes[node_id] = Node(
                node_id, "Forward", ports=ports, position=position, comment="drives & waits"
            )
        else:
            ports = {"code": f"speed := {number} * 0.5"}
            nodes[node_id] = Node(node_id, "Script", ports=ports, conditions={"_skipIf": "false"})
    return Tree("MainTree", "n0", nodes)


def measured(work: Callable[[], object]) -> tuple[float, float]:
    """The best time in seconds of a few runs, and the peak of memory in MB of one."""
    times = []
    for _ in range(REPEATS):
        started = time.perf_counter()
        work()
        times.append(time.perf_counter() - started)
    tracemalloc.start()
    work()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return min(times), peak / 1e6


def works(size: int) -> dict[str, Callable[[], object]]:
    """Returns the measured functions, by name."""
    files = project_files(Settings(), [made_tree(size)]) | {"actions/Forward.py": SOURCE.encode()}
    project = load(files)
    xml = to_xml(project)

    def translate() -> None:
        opened = load(files)
        check(opened)
        self_contained(opened)

    def know() -> None:
        context = Context(project)
        for one in KNOWING:
            one(context)

    return {
        "translate and check": translate,
        "know without running": know,
        "package": lambda: to_ros2_package(load(files)).to_zip(),
        "import": lambda: from_xml(xml),
        "import and export": lambda: to_xml(from_xml(xml)),
    }


def main() -> None:
    """Prints a line for each kind of work and size."""
    print(f"{'work':22} {'nodes':>7} {'ms':>9} {'µs/node':>9} {'peak MB':>9}")
    works(10)["package"]()  # fills the caches of templates and engine files
    for name in works(10):
        for size in SIZES:
            seconds, peak = measured(works(size)[name])
            line = f"{name:22} {size:7} {seconds * 1e3:9.1f} {seconds / size * 1e6:9.1f} {peak:9.1f}"
            target = TARGET_S.get(name)
            a_node = TARGET_US_A_NODE.get(name)
            end = f"   target {target:.0f} s" if target else f"   target {a_node} µs" if a_node else ""
            print(line + (end if size == SIZES[-1] else ""))


if __name__ == "__main__":
    main()
