"""A session with a real application and a fake world, for tests of the application process."""

from __future__ import annotations

import base64
import contextlib
import io
import sys
import zipfile
from pathlib import Path

import psutil

from executor.manager.manager import Manager, ManagerSettings, free_domain_id
from executor.manager.programs import session_programs
from executor.ros.environment import ros_environment
from executor.supervision.processes import Program
from tests.executor.session_client import TOKEN, SessionClient
from tests.processes import with_word

ROOT = Path(__file__).parents[3]
HEAD = """import py_trees
from py_trees.common import Status


class Act(py_trees.behaviour.Behaviour):
"""


def action(body):
    """Returns the source of an action with the given methods."""
    return HEAD + "".join(f"    {line}\n" if line else "\n" for line in body.strip("\n").split("\n"))


UPDATE_RUNNING = action("def update(self):\n    return Status.RUNNING")


def app(source, tree="<Act _bts_id='n1'/>", **files):
    code = f"<Code><Action name='Act'><![CDATA[{source}]]></Action></Code>"
    xml = f"<root BTCPP_format='4'><BehaviorTree ID='Main'>{tree}</BehaviorTree>{code}</root>"
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("self_contained_tree.xml", xml)
        for name, text in files.items():
            archive.writestr(name.replace("__", "/"), text)
    return base64.b64encode(packed.getvalue()).decode()


def run_data(app_zip, **more):
    return {"universe": {"universe": "x"}, "application": {"app_zip_base64": app_zip, "tick_hz": 20.0} | more}


@contextlib.asynccontextmanager
async def session(*, limits=None, mute_after_s=float("inf")):
    """Opens a session with a fake world and the real application."""
    domain_id = free_domain_id()
    programs = session_programs(domain_id)
    world = (sys.executable, str(ROOT / "tests/fakes/clock_world.py"), "--mute-after", str(mute_after_s))
    programs["world"] = Program(world, {**ros_environment(domain_id), "PYTHONPATH": str(ROOT)})
    if limits is not None:
        own = programs["application"]
        programs["application"] = Program(own.arguments, own.environment, limits)
    manager = Manager(ManagerSettings(port=0, token=TOKEN, domain_id=domain_id, programs=programs))
    client = await SessionClient(await manager.start()).open(stream=False)
    try:
        yield client
        await client.close()
    finally:
        await manager.close()
        assert with_word("channel-fd", psutil.Process().children(recursive=True)) == []


async def second_run_works(client):
    at = len(client.events)
    assert await client.ask("run", run_data(app(UPDATE_RUNNING))) == "ack"
    await client.event("tick", lambda d: d["n"] > 3, after=at)
