"""The translator on trees of 10 to 10,000 nodes: processor time, memory; the cost of a node must not grow.

Run alone with `python -m tests.benchmarks translator`.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from tests.benchmarks.figures import Figure, show
from tests.benchmarks.timing import best_s, peak_mb
from translator import Node, Settings, Tree, check, from_xml, load, self_contained, to_ros2_package, to_xml
from translator.check.context import Context
from translator.check.effect import check_effects
from translator.check.endless import check_endless_loops
from translator.check.order import check_order
from translator.check.reach import check_reachability
from translator.check.together import check_together
from translator.importer import project_files

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

SIZES = (10, 100, 1_000, 10_000)
KNOWING = (
    check_order,
    check_reachability,
    check_effects,
    check_endless_loops,
    check_together,
)
WIDTH = 10
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


def measure(_: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the time of each kind of work and size, and the memory of the largest."""
    works(10)["package"]()  # fills the caches of templates and engine files
    for size in SIZES:
        for name, work in works(size).items():
            yield Figure(f"{name}, {size:,} nodes", best_s(work) * 1e3, "ms")
    for name, work in works(SIZES[-1]).items():
        yield Figure(f"{name}, {SIZES[-1]:,} nodes, Python's objects", peak_mb(work), "MB")


def main() -> None:
    """Prints the figures; targets at 10,000 nodes: 1 s to translate and check, 0.3 s to know, else 2 s."""
    show(measure(sys.argv[1:]))


if __name__ == "__main__":
    main()
