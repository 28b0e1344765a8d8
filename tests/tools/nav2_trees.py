"""Writes `docs/reference/nav2-trees.md`: `make nav2-trees SOURCE=FOLDER`, FOLDER being a clone of Nav2.

Each tree of `nav2_bt_navigator/behavior_trees`, in the branch of each ROS distribution, drives through the
world *House* in lock-step, in a process of its own. Nothing of Nav2 is stored.

`--only humble/follow` runs the trees whose distribution and name begin so, and prints their rows.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.tools.nav2_drive import DURATION_S, GOAL, TOLERANCE_M, Row, Shipped
from tests.tools.nav2_tables import branch_in, git
from translator.nav2.distributions import DISTRIBUTIONS, titled

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from translator.nav2.distributions import Distribution

FOLDER: Final = "nav2_bt_navigator/behavior_trees"
ROOT: Final = Path(__file__).resolve().parents[2]
PAGE: Final = ROOT / "docs/reference/nav2-trees.md"


def commits_in(clone: Path) -> dict[Distribution, str]:
    """Returns the commit of each distribution's branch.

    Raises:
        ValueError: the clone lacks a branch.
    """
    branches = {name: branch_in(clone, name) for name in DISTRIBUTIONS}
    if lacking := [name for name, branch in branches.items() if not branch]:
        raise ValueError(f"{clone} has no branch {lacking[0]}: clone Nav2 with all its branches")
    return {name: git(clone, "rev-parse", branch).strip() for name, branch in branches.items()}


def trees_in(clone: Path, commits: Mapping[Distribution, str]) -> Iterator[Shipped]:
    """Yields the trees of each distribution, by name."""
    for distribution, commit in commits.items():
        listed = git(clone, "ls-tree", "--name-only", commit, f"{FOLDER}/").splitlines()
        for path in sorted(each for each in listed if each.endswith(".xml")):
            yield Shipped(distribution, Path(path).stem, git(clone, "show", f"{commit}:{path}"))


def rows_of(trees: Iterable[Shipped], *, jobs: int = 1) -> Iterator[Row]:
    """Yields the row of each tree, in their order.

    Raises:
        ValueError: a tree cannot be run.
    """
    with ThreadPoolExecutor(jobs) as pool:
        yield from pool.map(_row_of, trees)


def _row_of(tree: Shipped) -> Row:
    """Drives in a process of its own, since ROS reads its environment once."""
    command = [sys.executable, "-m", "tests.tools.nav2_drive"]
    text = json.dumps(asdict(tree))
    done = subprocess.run(command, input=text, capture_output=True, text=True, cwd=ROOT, check=False)
    if done.returncode:
        raise ValueError(f"{tree.distribution}, {tree.name}: {done.stderr}")
    return Row(*json.loads(done.stdout.splitlines()[-1]))


def line_of(row: Row) -> str:
    """Returns a row of the table."""
    return f"| {row.distribution} | `{row.tree}` | {row.outcome} | {row.plans} | {row.reason} |"


def page_of(rows: Sequence[Row], commits: Mapping[Distribution, str]) -> str:
    """Returns the page."""
    arrived = [row for row in rows if row.outcome == "arrived"]
    sources = [
        f"| {titled(name)} | `{name}` | `{commit}` | {sum(row.distribution == name for row in rows)} "
        f"| {sum(row.distribution == name for row in arrived)} |"
        for name, commit in commits.items()
    ]
    return "\n".join(
        [
            "<!-- Written by `make nav2-trees SOURCE=FOLDER`, FOLDER being a clone of Nav2; do not edit. -->",
            "# Nav2's trees in the world *House*",
            "",
            f"{len(arrived)} of the {len(rows)} trees that Nav2 ships arrive here, without Nav2. Each was",
            f"imported from `{FOLDER}`, changed to its ROS distribution, called",
            "from a tree that sets `goal` and `goals`, and run in lock-step, as",
            "[Navigate without Nav2](../how-to/navigate.md) describes.",
            "",
            f"* *arrived*: the tree succeeded, and the robot stands within {TOLERANCE_M:g} m of its goal,",
            f"  x {GOAL[0]:g} m and y {GOAL[1]:g} m in the kitchen. A tree that has no goal is to end",
            "  where it begins, an open place of the living room.",
            "* A tree that reads `waypoint_statuses` gets them from an action beside it, since Nav2's",
            "  navigator sets them.",
            f"* Otherwise: the result of the tree, RUNNING if it has no end after {DURATION_S:g} s.",
            "* *Plans*: the paths that the planner gave to the tree's nodes.",
            "* *Needs*: what a tree that does not arrive lacks here.",
            "",
            "| Distribution | Branch | Commit | Trees | Arrive |",
            "| --- | --- | --- | --- | --- |",
            *sources,
            "",
            "## Trees",
            "",
            "| Distribution | Tree | Outcome | Plans | Needs |",
            "| --- | --- | --- | --- | --- |",
            *map(line_of, rows),
            "",
        ]
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the trees, and writes the page."""
    parser = argparse.ArgumentParser(prog="nav2_trees", description=__doc__.partition("\n")[0])
    parser.add_argument("clone", type=Path, metavar="FOLDER")
    parser.add_argument("--only", default="", metavar="TEXT", help="run these, and write no page")
    parser.add_argument("--jobs", type=int, default=1, help="how many run at a time")
    parser.add_argument("--page", type=Path, default=PAGE, help="where the page is written")
    options = parser.parse_args(arguments)
    try:
        commits = commits_in(options.clone)
        trees = [
            tree
            for tree in trees_in(options.clone, commits)
            if f"{tree.distribution}/{tree.name}".startswith(options.only)
        ]
        if not trees:
            raise ValueError(f"{options.clone} has no tree {options.only} in {FOLDER}")
        rows = []
        for row in rows_of(trees, jobs=options.jobs):
            print(line_of(row), flush=True)
            rows.append(row)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    if not options.only:
        options.page.write_text(page_of(rows, commits), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
