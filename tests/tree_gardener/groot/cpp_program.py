"""A program of BehaviorTree.CPP with a Groot2 publisher, which ticks until its standard input ends."""

from __future__ import annotations

import select
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).parents[3]
XML = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence name="top"><Script code="a:=3; b:='x'"/>
<SubTree ID="Sub" x="{a}" name="mine"/><SubTree ID="Sub" x="{a}"/><Sleep msec="100"/><Script code="a+=1"/>
</Sequence></BehaviorTree>
<BehaviorTree ID="Sub"><Inverter><AlwaysFailure name="hey"/></Inverter></BehaviorTree></root>"""


@contextmanager
def cpp_program(port: int, xml: str = XML) -> Iterator[subprocess.Popen[str]]:
    """Runs the program until the end of the block, also one whose tree is held."""
    with subprocess.Popen(
        [sys.executable, "-m", "tests.tree_gardener.groot.cpp_program", str(port), xml],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def main(port: int, xml: str) -> None:
    """Ticks the tree."""
    import behaviortreepy as cpp

    factory = cpp.BehaviorTreeFactory()
    factory.register_behavior_tree_from_text(xml)
    tree = factory.create_tree("Main")
    publisher = cpp.Groot2Publisher(tree, port)
    while not select.select([sys.stdin], [], [], 0.01)[0]:
        tree.tick_once()
    del publisher


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
