"""The programs of a session's processes: commands, environments and limits."""

from __future__ import annotations

import os
import secrets
import sys
from typing import TYPE_CHECKING, Final

from executor.application.groot import PORT_VARIABLE
from executor.manager.environment import mebibytes, number
from executor.recorder.link import ADDRESS_VARIABLE
from executor.ros.environment import lockstep_environment, ros_environment
from executor.supervision.processes import Limits, Program
from executor.supervision.single_threaded import SINGLE_THREADED
from tree_gardener.ros_fields import VARIABLE as CHECK_FIELDS

if TYPE_CHECKING:
    from executor.session.events import Kind

# pydantic would search all installed packages.
NO_PLUGINS: Final = {"PYDANTIC_DISABLE_PLUGINS": "__all__"}
# Sharing a small picture between threads costs more than it gains, and sessions share one machine.
FEW_THREADS: Final = {"OPENCV_FOR_THREADS_NUM": "1", "LP_NUM_THREADS": "2"}


def session_programs(domain_id: int, groot2: int = 0, cluster: str = "") -> dict[Kind, Program]:
    """Returns the programs of world, application and recorder, with their limits.

    Args:
        domain_id: the ROS domain of the session.
        groot2: the port at which Groot2 can look at the tree; 0 for none.
        cluster: the address of the Ray cluster that runs evaluations; "" for this machine.
    """
    clustered = (f"--cluster={cluster}",) if cluster else ()
    shown = {PORT_VARIABLE: str(groot2)} if groot2 else {}
    threads = {name: os.environ.get(name, count) for name, count in FEW_THREADS.items()}
    link = {ADDRESS_VARIABLE: f"bt-studio-recorder-{secrets.token_hex(16)}"}
    environment = {**ros_environment(domain_id), **threads, **NO_PLUGINS, **link}
    limits = Limits(
        memory_bytes=mebibytes("BT_STUDIO_APPLICATION_MEMORY_MB", 4096),
        file_bytes=mebibytes("BT_STUDIO_APPLICATION_FILE_MB", 1024),
        processes=int(number("BT_STUDIO_APPLICATION_PROCESSES", 64)),
        cpu_s=int(number("BT_STUDIO_APPLICATION_CPU_S", 0)) or None,
    )
    return {
        "world": Program((sys.executable, "-m", "executor.world.process"), environment),
        "application": Program(
            (sys.executable, "-m", "executor.application.process"),
            {**environment, **shown, CHECK_FIELDS: "1"},  # also of the project's launch nodes
            limits,
        ),
        "exact": Program(
            (sys.executable, "-m", "executor.exact.process"),
            {**environment, **shown, **lockstep_environment(), **SINGLE_THREADED},
            limits,
            makes_snapshots=True,
        ),
        "recorder": Program((sys.executable, "-m", "executor.recorder.process"), link),
        "adapter": Program((sys.executable, "-m", "executor.debug_adapter.process")),
        "evaluation": Program(
            (sys.executable, "-m", "executor.evaluation.served.process", *clustered),
            dict(SINGLE_THREADED),
            Limits(file_bytes=limits.file_bytes),
        ),
    }


def attached_programs() -> dict[Kind, Program]:
    """Returns the programs of a session that follows another program; there is no world."""
    link = {ADDRESS_VARIABLE: f"bt-studio-recorder-{secrets.token_hex(16)}"}
    limits = Limits(memory_bytes=mebibytes("BT_STUDIO_APPLICATION_MEMORY_MB", 4096))
    follow = (sys.executable, "-m", "executor.attached.process")
    return {
        "world": Program((sys.executable, "-m", "executor.attached.world"), {}),
        "application": Program(follow, NO_PLUGINS | link, limits),
        "recorder": Program((sys.executable, "-m", "executor.recorder.process"), link),
    }
