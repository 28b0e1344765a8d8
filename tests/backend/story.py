"""A story that uses every endpoint: a teacher's project is made, written, shared, run and deleted.

It runs against the real views. Its requests and answers are the examples of the OpenAPI document.
"""

from __future__ import annotations

import io
import json
import re
import zipfile

from django.core.files.uploadedfile import SimpleUploadedFile

from backend.evaluations import writes
from backend.evaluations.choices import JobState
from backend.evaluations.models import Evaluation
from tests.backend.evaluations.conftest import ROOM, begin, done, store
from tests.executor.recorder.outside.logs import SAMPLES
from tests.executor.uploads.zips import CART

FORWARD = '''"""Drives ahead."""

from geometry_msgs.msg import Twist
from py_trees.behaviour import Behaviour
from py_trees.common import Status
from tree_gardener.ports import Port


class Forward(Behaviour):
    """Drives ahead at a speed."""

    INPUT_PORTS = {"speed": Port(float, 0.2, description="in m/s")}

    def setup(self, **kwargs):
        self.publisher = kwargs["node"].create_publisher(Twist, "cmd_vel", 10)

    def update(self):
        twist = Twist()
        twist.linear.x = self.get_input("speed")
        self.publisher.publish(twist)
        return Status.RUNNING
'''
TESTS = """format: bt-studio/test
version: 1
tests:
  - name: drives on
    doubles: {Forward: RUNNING}
    ticks: 20
    expect:
      - {at: 1..20, node: Forward, status: RUNNING}
      - {at: 20, root: SUCCESS}
"""
TREE = {
    "format": "bt-studio/diagram",
    "version": 1,
    "id": "MainTree",
    "root": "n1",
    "nodes": {
        "n1": {"type": "Forward", "name": "", "ports": {"speed": "0.3"}, "children": [], "x": 0, "y": 0},
    },
    "attributes": {"_description": "Drives ahead.", "_bts_offered": "1"},
}
MAX_TEXT = 240
MAX_ITEMS = 2
UUID = re.compile(r"[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")
TIME = re.compile(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?(Z|\+00:00)$")
LINK = re.compile(r"^(http://[^/]+/(?:join|shared)/).*$")


def _pattern(template):
    """Returns a pattern for the addresses of an operation; names of files and interfaces have slashes."""
    holes = re.sub(r"\{(path|interface)\}", "(.+)", template)
    return re.compile(re.sub(r"\{\w+\}", "([^/]+)", holes) + "$")


class Story:
    """Makes requests, and records the answers under the name of the operation."""

    def __init__(self, document):
        self.told = {}
        self._operations = [
            (method, _pattern(path), path, operation["operationId"])
            for path, operations in document["paths"].items()
            for method, operation in operations.items()
        ]
        self._ids = {}

    def ask(self, who, method, path, body=None, *, status=200, file=None, data=None):
        """Makes one request; returns its answer as JSON, or unchanged."""
        address = f"/api/v1/{path}"
        if file is not None:
            response = who.client.post(address, {"file": SimpleUploadedFile(*file)})
        elif data is not None:
            response = who.client.generic(method, address, data, "application/octet-stream")
        else:
            data = {} if body is None else {"data": json.dumps(body), "content_type": "application/json"}
            response = who.client.generic(method, address, **data)
        content = response.getvalue()
        assert response.status_code == status, (method, path, response.status_code, content[:1500])
        is_json = "json" in response.headers.get("Content-Type", "")
        answer = json.loads(content) if is_json else None
        row = self.told.setdefault(self._operation(method, address), {"answers": {}})
        if body is not None and status < 400:
            row["request"] = self._plain(body)
        if response.headers.get("Content-Type", "").startswith("text/"):
            row["answers"].setdefault(str(status), self._plain(content.decode()))
        if answer is not None:
            row["answers"].setdefault(str(status), self._plain(answer))
        return answer

    def _operation(self, method, address):
        path = address.partition("?")[0]
        found = [
            ("{" not in template, len(template), operation)
            for verb, pattern, template, operation in self._operations
            if verb == method.lower() and pattern.match(path)
        ]
        return max(found)[-1]

    def _plain(self, value, key=""):
        """Returns an answer that is the same in every recording, and short enough to read."""
        if isinstance(value, dict):
            kept = list(value.items())
            if key in {"nodes", "files"}:
                kept = kept[:MAX_ITEMS]
            return {name: self._plain(inner, name) for name, inner in kept}
        if isinstance(value, list):
            return [self._plain(inner) for inner in value[:MAX_ITEMS]]
        if not isinstance(value, str):
            return value
        if key == "version":
            return "1.0.0"
        if TIME.match(value):
            return "2026-02-17T10:15:00Z" if key == "expires_at" else "2026-02-03T10:15:00Z"
        text = LINK.sub(r"\g<1>3f2504e04f8941d39a0c.Zm9y", value)
        text = UUID.sub(self._id, text)
        return text if len(text) <= MAX_TEXT or "\n" in text else text[:MAX_TEXT] + "…"

    def _id(self, match):
        number = self._ids.setdefault(match[0], len(self._ids) + 1)
        return f"3f2504e0-4f89-41d3-9a0c-{number:012}"


def play(story, teacher, student, stranger, guest):
    """Plays the whole story.

    Args:
        story: records requests and answers.
        teacher: someone who may make groups.
        student: someone with an account.
        stranger: a browser in which nobody is signed in.
        guest: makes a browser that opened a read-only link.
    """
    one = _project(story, teacher, stranger)
    _files(story, teacher, one)
    _history(story, teacher, one)
    _people(story, teacher, student, one, guest)
    _run(story, teacher, one)
    _evaluate(story, teacher, one)
    _import(story, teacher, one)
    _tools(story, teacher)
    _end(story, teacher, student, one)


def _project(story, teacher, stranger):
    story.ask(stranger, "GET", "projects", status=401)
    made = story.ask(teacher, "POST", "projects", {"name": "Patrol", "template": "empty"}, status=201)
    one = f"projects/{made['id']}"
    story.ask(teacher, "POST", "projects", {"name": "Patrol"}, status=409)
    story.ask(teacher, "GET", "projects?search=pat&sort=-updated_at&limit=20")
    story.ask(teacher, "GET", one)
    story.ask(teacher, "GET", "projects/00000000-0000-4000-8000-000000000000", status=404)
    story.ask(teacher, "POST", "projects", {"title": "Patrol"}, status=422)
    return one


def _files(story, teacher, one):
    tree = json.dumps(TREE, indent=2)
    action = {"path": "actions/Forward.py", "base_revision": 0, "content": FORWARD}
    diagram = {"path": "trees/MainTree.json", "base_revision": 1, "content": tree}
    story.ask(teacher, "POST", f"{one}/changes", {"message": "Drive ahead", "files": [action, diagram]})
    story.ask(teacher, "GET", "projects/offers?limit=20")
    stale = {"message": "Drive faster", "files": [action | {"content": FORWARD.replace("0.2", "0.5")}]}
    story.ask(teacher, "POST", f"{one}/changes", stale, status=409)
    overlay = [{"path": "actions/Forward.py", "content": FORWARD.replace("def update(self)", "def update(")}]
    story.ask(teacher, "POST", f"{one}/check", {"files": overlay})
    story.ask(teacher, "POST", f"{one}/distribution", {"ros_distro": "lyrical", "files": []})
    tested = {"files": [{"path": "tests/main.test.yaml", "content": TESTS}]}
    story.ask(teacher, "POST", f"{one}/test", tested)
    story.ask(teacher, "POST", f"{one}/test-with-python", tested)
    story.ask(teacher, "GET", f"{one}/test-with-python")
    story.ask(teacher, "DELETE", f"{one}/test-with-python", status=404)
    story.ask(teacher, "POST", "actions/inspect", {"filename": "actions/Forward.py", "source": FORWARD})
    for address in (
        "app",
        "xml",
        "package",
        "package/preview",
        "cpp",
        "models",
        "xsd",
        "export",
        "files/actions/Forward.py",
    ):
        story.ask(teacher, "GET", f"{one}/{address}")
    draft = {"base_revision": 2, "content": FORWARD.replace("0.2", "0.4")}
    story.ask(teacher, "PUT", f"{one}/drafts/actions/Forward.py", draft)
    story.ask(teacher, "GET", f"{one}/drafts")
    story.ask(teacher, "DELETE", f"{one}/drafts/actions/Forward.py", status=204)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("trees/MainTree.json", tree)
        archive.writestr("actions/Forward.py", FORWARD)
    story.ask(teacher, "POST", "projects/import", status=201, file=("Imported.zip", packed.getvalue()))
    story.ask(teacher, "POST", "projects/import", status=422, file=("notes.zip", b"no archive"))


def _history(story, teacher, one):
    story.ask(
        teacher, "PATCH", one, {"base_revision": 1, "description": "Drives ahead until someone stops it."}
    )
    story.ask(teacher, "GET", f"{one}/revisions?limit=2")
    story.ask(teacher, "PATCH", f"{one}/revisions/2", {"label": "Before the lesson"})
    story.ask(teacher, "GET", f"{one}/revisions/2/diff")
    story.ask(teacher, "GET", f"{one}/revisions/2/files/actions/Forward.py")
    story.ask(teacher, "POST", f"{one}/revisions/2/restore", {"paths": ["project.json"]})
    story.ask(teacher, "POST", f"{one}/duplicate", {"name": "Patrol, second try"}, status=201)
    for verb in ("archive", "unarchive"):
        story.ask(teacher, "POST", f"{one}/{verb}")


def _people(story, teacher, student, one, guest):
    story.ask(student, "POST", "groups", {"name": "Mine"}, status=403)
    group = story.ask(teacher, "POST", "groups", {"name": "Robotics"}, status=201)
    of_group = f"groups/{group['id']}"
    story.ask(teacher, "PATCH", of_group, {"name": "Robotics 1"})
    invitation = story.ask(
        teacher, "POST", f"{of_group}/invitations", {"days": 14, "max_uses": 30}, status=201
    )
    student.form(invitation["url"].partition("example.org")[2])
    story.ask(teacher, "GET", of_group)
    story.ask(teacher, "GET", "groups")
    story.ask(teacher, "DELETE", f"invitations/{invitation['id']}", status=204)
    story.ask(student, "GET", one, status=404)
    story.ask(teacher, "POST", f"{one}/shares", {"name": "ben", "role": "editor"})
    story.ask(teacher, "POST", f"{one}/shares", {"name": "bne", "role": "editor"}, status=404)
    story.ask(teacher, "PUT", f"{one}/shares/groups/{group['id']}", {"role": "viewer"})
    shares = story.ask(teacher, "POST", f"{one}/shares/links", {"days": 14}, status=201)
    reader = guest(shares["links"][0]["url"])
    story.ask(reader, "POST", f"{one}/duplicate", {}, status=403)
    story.ask(teacher, "GET", f"{one}/shares")
    story.ask(student, "DELETE", one, status=403)
    story.ask(teacher, "POST", f"{one}/transfer", {"name": "ben"})
    story.ask(student, "POST", f"{one}/transfer", {"name": "tina"})
    story.ask(teacher, "DELETE", f"{one}/shares/links/{shares['links'][0]['id']}", status=204)
    story.ask(teacher, "DELETE", f"{one}/shares/groups/{group['id']}", status=204)
    story.ask(teacher, "DELETE", f"{one}/shares/people/ben", status=204)
    story.ask(teacher, "DELETE", f"{of_group}/members/ben", status=204)
    story.ask(teacher, "DELETE", of_group, status=204)


def _run(story, teacher, one):
    session = story.ask(teacher, "POST", f"{one}/session")
    story.ask(teacher, "GET", f"sessions/{session['id']}")
    story.ask(teacher, "GET", "sessions")
    story.ask(teacher, "POST", "sessions/attached/prepare", status=204)
    story.ask(teacher, "POST", "sessions/attached", {"address": "robot.local"})
    run = story.ask(teacher, "POST", f"{one}/runs", {"run": "a1", "name": "Into the crate"}, status=201)
    story.ask(teacher, "GET", f"{one}/runs")
    story.ask(teacher, "GET", f"{one}/runs/{run['id']}")
    story.ask(teacher, "PATCH", f"{one}/runs/{run['id']}", {"note": "It turned too late.", "is_shared": True})
    story.ask(teacher, "GET", f"{one}/runs/{run['id']}/recording")
    story.ask(teacher, "GET", f"{one}/runs/{run['id']}/thumbnail")
    story.ask(teacher, "GET", "runs")
    story.ask(teacher, "DELETE", f"{one}/runs/{run['id']}", status=204)
    log = (SAMPLES / "patrol.btlog").read_bytes()
    story.ask(teacher, "POST", f"{one}/runs/logs?filename=patrol.btlog", data=log, status=201)
    opened = story.ask(teacher, "POST", "runs/logs?filename=patrol.btlog", data=log, status=201)
    story.ask(teacher, "DELETE", f"runs/{opened['id']}", status=204)
    story.ask(teacher, "DELETE", f"sessions/{session['id']}", status=204)


def _import(story, teacher, one):
    query, cart = "filename=cart.urdf", CART.encode()
    story.ask(teacher, "POST", f"{one}/imports/inspect?{query}", data=cart)
    story.ask(teacher, "POST", f"{one}/imports?{query}&kind=robot&name=cart", data=cart, status=201)
    story.ask(teacher, "POST", f"{one}/imports?{query}&kind=robot&name=cart", data=cart, status=409)
    story.ask(teacher, "POST", f"{one}/imports?{query}&kind=robot", data=b"<robot name='cart'>", status=422)


def _evaluate(story, teacher, one):
    """An evaluation of which one run is done."""
    file = {"path": "evaluations/room.yaml", "base_revision": 0, "content": ROOM.decode()}
    story.ask(teacher, "POST", f"{one}/changes", {"message": "Evaluate", "files": [file]})
    of_room = f"{one}/evaluations"
    made = story.ask(teacher, "POST", of_room, {"name": "room", "runs": 2}, status=201)
    found = Evaluation.objects.select_related("project").get(id=made["id"])
    begin(found, 2)
    store(found, done(0, wanted=2))
    own = f"{of_room}/{made['id']}"
    story.ask(teacher, "GET", of_room)
    story.ask(teacher, "GET", own)
    story.ask(teacher, "GET", f"{own}/coverage")
    story.ask(teacher, "GET", f"{own}/outcomes")
    story.ask(teacher, "GET", f"{own}/outcomes/0")
    story.ask(teacher, "GET", f"{own}/runs.jsonl")
    story.ask(teacher, "GET", f"{own}/report.html")
    replay = story.ask(teacher, "POST", f"{own}/replays", {"revision": found.revision, "seed": 0}, status=201)
    story.ask(teacher, "GET", f"{own}/replays/{replay['id']}")
    story.ask(teacher, "DELETE", f"{own}/replays/{replay['id']}", status=204)
    story.ask(teacher, "POST", f"{own}/cancel")
    story.ask(teacher, "POST", f"{own}/compare", {"revision": found.revision - 1})
    story.ask(teacher, "POST", f"{own}/resume", status=409)
    writes.finish(Evaluation.objects.get(id=made["id"]), JobState.CANCELLED)
    story.ask(teacher, "POST", f"{own}/resume")
    story.ask(teacher, "GET", f"{own}/comparison")
    story.ask(teacher, "DELETE", own, status=204)


def _tools(story, teacher):
    source = {"filename": "actions/Forward.py", "source": "import os\nx=1\n"}
    story.ask(teacher, "POST", "python/format", source)
    story.ask(teacher, "POST", "python/lint", source)
    tree = {"diagram": json.dumps(TREE)}
    answer = story.ask(teacher, "POST", "trees/xml", tree)
    story.ask(teacher, "POST", "trees/diagram", tree | {"xml": answer["xml"].replace("0.3", "0.6")})
    for name in ("nodes", "actions", "interfaces", "universes", "robots", "templates", "behaviours"):
        story.ask(teacher, "GET", f"catalog/{name}")
    story.ask(teacher, "GET", "catalog/interfaces/geometry_msgs/msg/Twist")
    universe = story.ask(teacher, "GET", "catalog/universes")["items"][0]["id"]
    robot = story.ask(teacher, "GET", "catalog/robots")["items"][0]["id"]
    story.ask(teacher, "GET", f"catalog/universes/{universe}/text")
    story.ask(teacher, "GET", f"catalog/robots/{robot}/config")
    story.ask(teacher, "GET", f"catalog/robots/{robot}/urdf")
    story.ask(teacher, "GET", f"catalog/universes/{universe}/preview")
    story.ask(teacher, "GET", f"catalog/robots/{robot}/preview")


def _end(story, teacher, student, one):
    story.ask(teacher, "DELETE", one, status=204)
    story.ask(teacher, "POST", f"{one}/restore")
    story.ask(teacher, "GET", "me")
    story.ask(teacher, "GET", "me/usage")
    story.ask(teacher, "GET", "me/data")
    story.ask(student, "DELETE", "me/data", {"username": "someone"}, status=422)
    story.ask(student, "DELETE", "me/data", {"username": "ben"}, status=204)
