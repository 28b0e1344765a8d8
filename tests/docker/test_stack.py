"""The team's server as it is deployed: real images, real containers, careless and hostile users."""

from __future__ import annotations

import asyncio
import json
import os
import time
from contextlib import asynccontextmanager
from pathlib import Path

import pytest
from websockets.exceptions import ConnectionClosed

from tests.docker.engine import build_images, engine
from tests.docker.stack import Stack

# A developer who has built the images may pass their tag.
BUILT = os.environ.get("BT_STUDIO_TEST_IMAGES", "")
TAG = BUILT or "test"
INTRUDER = (Path(__file__).parent / "intruder.py").read_text()
BUMP, FOLLOW = "laser_bump_and_go", "visual_follow_person"
ACTION = """
import py_trees

class Forward(py_trees.behaviour.Behaviour):
    def __init__(self, name, ports=None):
        super().__init__(name)

    def update(self):
{body}
        return py_trees.common.Status.RUNNING
"""
FORK_BOMB = "        import os\n        while True:\n            os.fork()"
MEMORY_HOG = "        self.hoard = getattr(self, 'hoard', []) + [bytearray(200 << 20)]"
DISK_FILLER = (
    "        import os\n        for n in range(10**6):\n"
    "            with open(f'/tmp/{n}', 'wb') as file:\n                file.write(os.urandom(8 << 20))"
)
# A build from scratch takes minutes on a busy machine.
pytestmark = [pytest.mark.timeout(1800)]


@pytest.fixture(scope="module")
def stack(tmp_path_factory):
    """Builds the images, and yields the stack with two places for robots."""
    folder = tmp_path_factory.mktemp("docker")
    with engine(folder) as running:
        if not BUILT:
            build_images(running, TAG)
        made = Stack(running, folder, TAG, BT_STUDIO_MAX_SESSIONS="2", BT_STUDIO_SESSION_CPUS="1")
        try:
            print(f"from built images to the first page: {made.up():.1f} s")
            yield made
        finally:
            print(made.compose("logs", "--tail=60", check=False).stdout)
            made.down()


@pytest.fixture(scope="module")
def ann(stack):
    return stack.add_user("ann")


@pytest.fixture(scope="module")
def ben(stack):
    return stack.add_user("ben")


@pytest.fixture(scope="module")
def projects(ann, ben):
    """Creates one of the examples for each user."""
    return {
        BUMP: ann.post("projects", {"name": "Bump", "template": BUMP})["id"],
        FOLLOW: ben.post("projects", {"name": "Follow", "template": FOLLOW})["id"],
    }


@asynccontextmanager
async def started(user, project):
    """Yields a client of the project's session after its introduction; it leaves at the end."""
    client = await user.open_session(user.post(f"projects/{project}/session"))
    try:
        yield client
    finally:
        await client.close()


def distance_m(client):
    """Returns the distance that the robot has driven."""
    return max((sim["distance_m"] for sim in client.named("sim")), default=0.0)


async def run(client, user, project, universe):
    """Runs the project as it is stored."""
    await run_app(client, user.app(project), universe)


async def run_app(client, app, universe="walled_room", **more):
    application = {"app_zip_base64": app, "tick_hz": 20.0, "on_finish": "repeat", **more}
    reply = await client.ask(
        "run", {"universe": {"universe": universe, "seed": 1}, "application": application}, timeout_s=240
    )
    assert reply == "ack", reply


def ticks(client):
    return max((tick["n"] for tick in client.named("tick")), default=0)


async def until(condition, timeout_s):
    """Waits for a condition that no message reports."""
    async with asyncio.timeout(timeout_s):
        while not condition():  # noqa: ASYNC110
            await asyncio.sleep(0.2)


async def ticks_on(client):
    """Waits until the robot's program ticks."""
    before = ticks(client)
    await client.until(lambda: ticks(client) > before + 5, 120)


def hostile(user, project, source):
    """Returns the project's app with another Forward, made by the server from a stored project."""
    copy = user.post(f"projects/{project}/duplicate", {"name": f"copy {time.monotonic_ns()}"})
    save(user, copy["id"], "actions/Forward.py", source, base=copy["revision"])
    app = user.app(copy["id"])
    user.delete(f"projects/{copy['id']}")
    return app


def save(user, project, path, content, *, base=0):
    """Saves one file."""
    change = {"files": [{"path": path, "content": content, "base_revision": base}]}
    return user.post(f"projects/{project}/changes", change)


async def test_two_users_run_both_examples_in_two_containers(stack, ann, ben, projects):
    async with started(ann, projects[BUMP]) as first, started(ben, projects[FOLLOW]) as second:
        await asyncio.gather(
            run(first, ann, projects[BUMP], "walled_room"),
            run(second, ben, projects[FOLLOW], "person_in_green"),
        )
        assert len(stack.sessions()) == 2
        for client in (first, second):
            await client.until(lambda c=client: distance_m(c) > 0.05, 120)


async def test_a_stranger_reaches_neither_project_nor_session(ann, ben, projects):
    session = ann.post(f"projects/{projects[BUMP]}/session")
    for attempt in (
        lambda: ben.get(f"projects/{projects[BUMP]}"),
        lambda: ben.get(f"sessions/{session['id']}"),
        lambda: ben.delete(f"sessions/{session['id']}"),
    ):
        with pytest.raises(AssertionError, match="404"):
            attempt()
    async with ben.client_of(session)._connect("/control") as socket:
        with pytest.raises(ConnectionClosed) as caught:
            await socket.recv()
    assert caught.value.rcvd.code == 4404


async def test_user_code_finds_no_way_out(stack, ann, ben, projects):
    mine = ann.post(f"projects/{projects[BUMP]}/session")["id"]
    other = ben.post(f"projects/{projects[FOLLOW]}/session")["id"]
    # The address of this machine where the server is published: the nearest network outside.
    told = {"OWN_SESSION": mine, "OTHER_SESSION": other, "HOST": stack.gateway(), "PORT": stack.port}
    secret = "".join(f"{name} = {value!r}\n" for name, value in told.items())
    async with started(ann, projects[BUMP]) as client:
        await run_app(client, hostile(ann, projects[BUMP], INTRUDER + secret))
        line = await client.event("log", lambda data: data["text"].startswith("FOUND "), timeout_s=60)
    found = json.loads(line["data"]["text"].removeprefix("FOUND "))
    assert found["uid"] == 10001
    assert set(found["capabilities"]) == {"0"}
    assert (found["no_new_privileges"], found["seccomp"]) == ("1", "2")
    assert found["interfaces"] == ["lo"]
    assert found["routes"] == []
    for place in ("postgres", "redis", "web", "host", "gate_write", "gate_folder", "vsock", "io_uring"):
        assert found[place].startswith("refused"), place
    for place in ("gate_own", "gate_other", "root_write"):
        assert found[place].startswith("refused"), place
    assert found["docker"] == found["studio_files"] == []
    assert found["mount"] == -1
    assert found["managers"] == 1


GREEDY = {
    "disk filler": (DISK_FILLER, "no room left"),
    "memory hog": (MEMORY_HOG, "limit of memory"),
    "fork bomb": (FORK_BOMB, "processes"),
}


def reasons(client):
    """Returns the reasons for the end of a run or its session, as its user receives them."""
    faults = client.named("fault")
    told = [" ".join(str(fault.get(key) or "") for key in ("message", "hint")) for fault in faults]
    return "\n".join([*told, client.control.close_reason or ""])


async def test_a_greedy_program_ends_alone_and_its_user_gets_the_reason(ann, ben, projects):
    project = projects[BUMP]
    async with started(ben, projects[FOLLOW]) as bystander:
        await run(bystander, ben, projects[FOLLOW], "person_in_green")
        for kind, (body, why) in GREEDY.items():
            # The session continues where its manager could end the program; then the disk is full.
            async with started(ann, project) as greedy:
                await run_app(greedy, hostile(ann, project, ACTION.format(body=body)))
                # Its manager ends the program, or, if that is starved, the keeper ends the session.
                await until(lambda g=greedy: g.state != "application_running" or g.is_closed, 240)
                print(f"{kind}: {reasons(greedy)}")
                assert why in reasons(greedy)
            await ticks_on(bystander)
    # The next session works normally.
    ann.delete(f"sessions/{ann.post(f'projects/{project}/session')['id']}")
    async with started(ann, project) as again:
        await run(again, ann, project, "walled_room")
        await ticks_on(again)


async def test_python_is_read_in_containers_of_its_users(stack, ann, ben, projects):
    for user in (ann, ben):
        formatted = user.post("python/format", {"source": "x = {  'a':1 }\n", "filename": "actions/Go.py"})
        assert formatted == {"source": 'x = {"a": 1}\n', "findings": []}
    assert len(stack.tools()) == 2
    format_ = "{{.HostConfig.NetworkMode}} {{.HostConfig.ReadonlyRootfs}} {{.Config.User}} {{len .Mounts}}"
    for name in stack.tools():
        inspected = stack.engine.run("inspect", "-f", format_, name).stdout.split()
        assert inspected == ["none", "true", "10001:10001", "1"]
    programs = stack.compose("exec", "-T", "web", "ls", "/opt/bt-studio/.venv/bin").stdout.split()
    assert "uvicorn" in programs
    assert not {"ruff", "ty"} & set(programs)

    go = "file:///project/actions/Go.py"
    source = "from geometry_msgs.msg import Twist\nfrom actions.Turn import Turn\nTwist().linear."
    async with ann.open_language(projects[BUMP]) as editor:

        async def ask(number, method, **params):
            message = {"jsonrpc": "2.0", "id": number, "method": method, "params": params}
            await editor.send(json.dumps(message))
            async with asyncio.timeout(120):
                while (answer := json.loads(await editor.recv())).get("id") != number:
                    pass
            return answer["result"]

        await ask(1, "initialize", rootUri="file:///project", capabilities={})
        await editor.send(json.dumps({"jsonrpc": "2.0", "method": "initialized", "params": {}}))
        document = {"uri": go, "languageId": "python", "version": 1, "text": source}
        opened = {"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": document}}
        await editor.send(json.dumps(opened))
        position = {"line": 2, "character": 15}
        items = await ask(2, "textDocument/completion", textDocument={"uri": go}, position=position)
        assert [item["label"] for item in items["items"]][:3] == ["x", "y", "z"]
        place = {"textDocument": {"uri": go}, "position": {"line": 1, "character": 28}}
        [found] = await ask(3, "textDocument/definition", **place)
        assert found["uri"] == "file:///project/actions/Turn.py"


async def test_a_killed_web_server_loses_no_project_and_no_running_robot(stack, ann, ben, projects):
    project = projects[BUMP]
    async with started(ann, project) as client, started(ben, projects[FOLLOW]):
        await run(client, ann, project, "walled_room")
        await ticks_on(client)
        mine, orphan = (
            user.post(f"projects/{its}/session")["id"] for user, its in owners(ann, ben, projects)
        )
        base = ann.get(f"projects/{project}")["revision"]
        save(ann, project, "assets/note.txt", "saved just before the end")
        before = ticks(client)
        stack.engine.run("kill", "--signal", "KILL", stack.container("web"))
    assert len(stack.sessions()) == 2
    # One of the two is not recorded anywhere.
    forget = f"DELETE FROM executor_sessions_session WHERE id = '{orphan}'"  # noqa: S608 - our own
    stack.compose("exec", "-T", "postgres", "psql", "-U", "studio", "-c", forget)
    stack.compose("up", "-d", "web")
    stack.await_page()
    # The lease of the server that died runs out first.
    await until(lambda: len(stack.sessions()) == 1, 120)
    assert stack.sessions()[0].endswith(mine)
    stored = {file["path"]: file for file in ann.get(f"projects/{project}")["files"]}
    assert stored["assets/note.txt"]["revision"] > base
    assert stored["assets/note.txt"]["content"] == "saved just before the end"
    async with started(ann, project) as again:
        await again.event("snapshot", timeout_s=60)
        assert again.state == "application_running"
        await again.until(lambda: ticks(again) > before, 120)


def owners(ann, ben, projects):
    return ((ann, projects[BUMP]), (ben, projects[FOLLOW]))


async def test_a_full_server_queues_and_says_the_position(stack, ann, ben, projects):
    third = ann.post("projects", {"name": "Third", "template": BUMP})["id"]
    fourth = ben.post("projects", {"name": "Fourth", "template": BUMP})["id"]
    running = [
        ann.post(f"projects/{projects[BUMP]}/session"),
        ben.post(f"projects/{projects[FOLLOW]}/session"),
    ]
    waiting = [ann.post(f"projects/{third}/session"), ben.post(f"projects/{fourth}/session")]
    assert [one["state"] for one in waiting] == ["queued", "queued"]
    assert [one["position"] for one in waiting] == [1, 2]
    client = ann.client_of(waiting[0])
    opening = asyncio.create_task(client.open(stream=False))
    await until(lambda: client.named("progress"), 120)
    await asyncio.to_thread(ann.delete, f"sessions/{running[0]['id']}")
    await asyncio.wait_for(opening, 120)
    assert "number 1" in client.named("progress")[0]["message"]
    assert ben.get(f"sessions/{waiting[1]['id']}")["position"] == 1
    await client.close()
    for user, session in ((ann, waiting[0]), (ben, waiting[1]), (ben, running[1])):
        user.delete(f"sessions/{session['id']}")
    assert stack.sessions() == []


def test_a_backup_is_restored_into_an_empty_stack(stack, ann, projects):
    archive = stack.backup()
    listed = ann.get("projects")["items"]
    stack.down()
    stack.up()
    stack.restore(archive)
    ann.sign_in()
    assert ann.get("projects")["items"] == listed
