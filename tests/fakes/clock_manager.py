"""A manager with the real application and a world without physics, see `clock_world`."""

from __future__ import annotations

import argparse
import asyncio
import os
import sys
from dataclasses import replace
from pathlib import Path

from executor.manager.manager import ManagerSettings, free_domain_id, serve
from executor.manager.programs import session_programs
from executor.ros.environment import ros_environment
from executor.supervision.confine import die_with_parent
from executor.supervision.processes import Limits, Program

ROOT = Path(__file__).parents[2]


def main() -> None:
    """Serves a session until it is ended."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ready-fd", type=int, required=True)
    parser.add_argument("--mute-after", default="inf", help="when the world publishes no more time, in s")
    parser.add_argument("--memory", type=int, help="limits of the application, in bytes")
    parser.add_argument("--file", type=int)
    parser.add_argument("--processes", type=int)
    options = parser.parse_args()
    die_with_parent()
    domain_id = free_domain_id()
    programs = session_programs(domain_id)
    world = (sys.executable, str(ROOT / "tests/fakes/clock_world.py"), "--mute-after", options.mute_after)
    programs["world"] = Program(world, {**ros_environment(domain_id), "PYTHONPATH": str(ROOT)})
    if options.memory is not None:
        limits = Limits(options.memory, options.file, options.processes)
        programs["application"] = replace(programs["application"], limits=limits)
    token = os.environ.pop("TOKEN")
    settings = ManagerSettings(port=0, token=token, domain_id=domain_id, grace_s=0, programs=programs)
    asyncio.run(serve(settings, options.ready_fd))


if __name__ == "__main__":
    main()
