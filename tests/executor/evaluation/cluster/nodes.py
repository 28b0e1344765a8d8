"""Runs seeds on a Ray cluster of some nodes, in a process of its own, and prints the outcomes.

Arguments: folder of the project, number of seeds, number of nodes. With two nodes, a supervisor and then a
node are killed while they work.
"""

import os
import sys
import threading
import time
from pathlib import Path
from typing import Any

import psutil

from executor.evaluation.cluster.ray_pool import import_ray, patiently
from executor.evaluation.evaluate import Progress, evaluate
from executor.evaluation.plan import Plan, make_plan
from translator import open_path

MEMORY = 100 << 20


def supervisors() -> list[psutil.Process]:
    """Returns the supervisors of this cluster that have begun to fork."""
    found = []
    for process in psutil.Process().children(recursive=True):
        try:
            if "executor.evaluation.cluster.batch" in process.cmdline() and process.children(recursive=True):
                found.append(process)
        except psutil.Error:
            continue
    found = [each for each in found if each.ppid() not in {other.pid for other in found}]
    return found


def wait_for(count: int) -> list[psutil.Process]:
    end_s = time.monotonic() + 120
    while len(found := supervisors()) < count and time.monotonic() < end_s:
        time.sleep(0.05)
    return found


def main() -> None:
    folder, seeds, nodes = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    plan = make_plan(open_path(folder), "main")
    import_ray(is_own=False)
    from ray.cluster_utils import Cluster

    os.environ.pop("RAY_ADDRESS", None)
    options: dict[str, Any] = {
        "num_cpus": 1,
        "object_store_memory": MEMORY,
        "include_dashboard": False,
    }
    cluster = Cluster()
    try:
        progress = evaluated(
            plan, cluster, [patiently(lambda: cluster.add_node(**options)) for _ in range(nodes)], seeds
        )
    finally:
        cluster.shutdown()  # otherwise its address stays noted for every later Ray of this machine
    for seed in sorted(progress.outcomes):
        print(progress.outcomes[seed].to_line())  # noqa: T201 - the result


def evaluated(plan: Plan, cluster: Any, started: list[Any], seeds: int) -> Progress:
    """Evaluates; with two nodes, a supervisor and then a node are killed."""
    told: list[str] = []

    def harm() -> None:
        wait_for(2)[0].kill()
        wait_for(2)
        cluster.remove_node(started[1])
        told.append("killed")

    thread = threading.Thread(target=harm, daemon=True)

    def hear(_: object, done: object) -> None:
        if done is not None and len(started) > 1 and not thread.ident:
            thread.start()

    progress = evaluate(plan, range(seeds), cluster=cluster.address, told=hear)
    if len(started) > 1:
        thread.join(60)
        assert told == ["killed"]
    return progress


main()
