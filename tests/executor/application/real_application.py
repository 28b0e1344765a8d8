"""A session with a real application and a fake world, for tests of the application process."""

from __future__ import annotations

import base64
import contextlib
import io
import zipfile

from tests.executor.session_client import SessionClient
from tests.executor.warm import WarmManager, warm_session

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


CLOCK = "tests.fakes.clock_manager"
LIMITED = (CLOCK, "--memory", str(1500 << 20), "--file", str(20 << 20), "--processes", "200")
"""The manager whose application has small limits."""


@contextlib.asynccontextmanager
async def session(*command):
    """Opens a session with a fake world and the real application, of a manager that other tests use, too."""
    async with warm_session(*(command or (CLOCK,)), stream=False) as (_, client):
        yield client


@contextlib.asynccontextmanager
async def own_session(*arguments):
    """Opens such a session with its own processes; yields its manager and a client."""
    manager = WarmManager(CLOCK, *arguments)
    try:
        client = await SessionClient(manager.port).open(stream=False)
        yield manager, client
        await client.close()
    finally:
        manager.close()


async def second_run_works(client):
    at = len(client.events)
    assert await client.ask("run", run_data(app(UPDATE_RUNNING))) == "ack"
    await client.event("tick", lambda d: d["n"] > 3, after=at)
