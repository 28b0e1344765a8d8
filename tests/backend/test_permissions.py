"""Every endpoint × every role × someone else's project; the policy is in `backend.projects.storage.access`.

The list of endpoints is the OpenAPI document, so that a new one without a row here fails.
"""

from __future__ import annotations

import uuid

import pytest
from django.core.files.uploadedfile import SimpleUploadedFile

from backend.accounts import groups, invitations
from backend.accounts.models import GroupMember
from backend.catalog import queries
from backend.config.schema_view import document
from backend.evaluations.choices import JobState
from backend.evaluations.models import Evaluation, Outcome, Replay
from backend.projects.api import views_legacy
from backend.projects.choices import Role
from backend.projects.models import GroupShare
from backend.projects.sharing import memberships
from backend.projects.storage import writes
from backend.runs.models import Run
from backend.sessions.choices import SessionState
from backend.sessions.lifecycle import writes as session_writes
from backend.sessions.models import Session
from tests.backend.accounts.conftest import PUBLIC, Person, person, stranger, team  # noqa: F401

ROLES = ("nobody", "guest", "other", "viewer", "editor", "owner")
TREE = b'{"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": null, "nodes": {}}'

# The status for each role, in the order of ROLES. 404: as if the project did not exist.
READ = (401, 200, 404, 200, 200, 200)
COPY = (401, 403, 404, 201, 201, 201)
WRITE = (401, 403, 404, 403, 200, 200)
DELETE_DRAFT = (401, 403, 404, 403, 204, 204)
DRAFTS = (401, 403, 404, 403, 200, 200)
MANAGE = (401, 403, 404, 403, 403, 200)
MANAGE_READ = (401, 403, 404, 403, 403, 200)
MANAGE_NEW = (401, 403, 404, 403, 403, 201)
MANAGE_GONE = (401, 403, 404, 403, 403, 204)
RUN = (401, 403, 404, 200, 200, 200)
CHECK = (401, 403, 404, 200, 200, 200)
NOT_OWNED = (401, 403, 404, 404, 404, 404)  # a session, group or invitation of another user
OWN = (401, 403, 404, 404, 404, 200)
RUN_READ = (401, 404, 404, 404, 404, 200)  # a teacher's run, which is not shared
RUN_CHANGE = (401, 403, 404, 404, 404, 200)
RUN_GONE = (401, 403, 404, 404, 404, 204)
PERSONAL = (401, 403, 200, 200, 200, 200)
CONTAINED = (401, 403, 503, 503, 503, 503)  # this server has no containers for reading Python
OPEN = (401, 200, 200, 200, 200, 200)
NEW = (401, 403, 201, 201, 201, 201)
BROKEN = (401, 422, 404, 422, 422, 422)  # the empty project has no root to translate
TESTED = (401, 403, 404, 422, 422, 422)  # as above, but guests cannot post

P = "/api/v1/projects/{project_id}"
E = P + "/evaluations/{evaluation_id}"
POLICY = {
    ("get", "/api/v1/projects"): PERSONAL,
    ("post", "/api/v1/projects"): NEW,
    ("post", "/api/v1/projects/import"): NEW,
    ("get", "/api/v1/projects/offers"): PERSONAL,
    ("get", P): READ,
    ("patch", P): WRITE,
    ("delete", P): MANAGE_GONE,
    ("post", f"{P}/restore"): MANAGE,
    ("post", f"{P}/archive"): MANAGE,
    ("post", f"{P}/unarchive"): MANAGE,
    ("post", f"{P}/duplicate"): COPY,
    ("post", f"{P}/changes"): WRITE,
    ("post", f"{P}/check"): CHECK,
    ("post", f"{P}/distribution"): CHECK,
    ("post", f"{P}/test"): TESTED,
    ("get", f"{P}/test-with-python"): RUN,
    ("delete", f"{P}/test-with-python"): (401, 403, 404, 404, 404, 404),  # there is nothing to end
    ("post", f"{P}/test-with-python"): (401, 403, 404, 503, 503, 503),  # there are no containers
    ("post", f"{P}/imports"): (401, 403, 404, 403, 503, 503),  # there are no containers
    ("post", f"{P}/imports/inspect"): (401, 403, 404, 403, 503, 503),  # as above
    ("get", f"{P}/app"): BROKEN,
    ("get", f"{P}/xml"): BROKEN,
    ("get", f"{P}/package"): BROKEN,
    ("get", f"{P}/package/preview"): BROKEN,
    ("get", f"{P}/cpp"): BROKEN,
    ("get", f"{P}/models"): READ,
    ("get", f"{P}/xsd"): READ,
    ("get", f"{P}/export"): READ,
    ("get", f"{P}/files/{{path}}"): READ,
    ("get", f"{P}/revisions"): READ,
    ("patch", f"{P}/revisions/{{number}}"): WRITE,
    ("get", f"{P}/revisions/{{number}}/diff"): READ,
    ("post", f"{P}/revisions/{{number}}/restore"): WRITE,
    ("get", f"{P}/revisions/{{number}}/files/{{path}}"): READ,
    ("get", f"{P}/drafts"): DRAFTS,
    ("put", f"{P}/drafts/{{path}}"): WRITE,
    ("delete", f"{P}/drafts/{{path}}"): DELETE_DRAFT,
    ("get", f"{P}/shares"): MANAGE_READ,
    ("post", f"{P}/shares"): MANAGE,
    ("delete", f"{P}/shares/people/{{username}}"): MANAGE_GONE,
    ("put", f"{P}/shares/groups/{{group_id}}"): (401, 403, 404, 403, 403, 404),
    ("delete", f"{P}/shares/groups/{{group_id}}"): MANAGE_GONE,
    ("post", f"{P}/shares/links"): MANAGE_NEW,
    ("delete", f"{P}/shares/links/{{link_id}}"): MANAGE_GONE,
    ("post", f"{P}/transfer"): MANAGE,
    ("post", f"{P}/session"): RUN,
    ("get", f"{P}/runs"): READ,
    ("post", f"{P}/runs"): (401, 403, 404, 409, 409, 409),  # no session of theirs runs
    ("post", f"{P}/runs/logs"): (401, 403, 404, 503, 503, 503),  # no containers for reading logs
    ("get", f"{P}/runs/{{run_id}}"): RUN_READ,
    ("patch", f"{P}/runs/{{run_id}}"): RUN_CHANGE,
    ("delete", f"{P}/runs/{{run_id}}"): RUN_GONE,
    ("get", f"{P}/runs/{{run_id}}/recording"): RUN_READ,
    ("get", f"{P}/runs/{{run_id}}/thumbnail"): RUN_READ,
    ("get", f"{P}/evaluations"): READ,
    ("post", f"{P}/evaluations"): (401, 403, 404, 403, 422, 422),  # the project has no such evaluation
    ("get", E): READ,
    ("delete", E): (401, 403, 404, 403, 204, 404),  # the editor has deleted it
    ("post", f"{E}/cancel"): WRITE,
    ("post", f"{E}/resume"): (401, 403, 404, 403, 200, 409),  # the editor has resumed it
    ("post", f"{E}/compare"): (401, 403, 404, 403, 422, 422),  # no older revision
    ("get", f"{E}/comparison"): (401, 409, 404, 409, 409, 409),  # it is not compared
    ("get", f"{E}/coverage"): (401, 422, 404, 422, 422, 422),  # the empty project has no root
    ("get", f"{E}/outcomes"): READ,
    ("get", f"{E}/outcomes/{{seed}}"): READ,
    ("post", f"{E}/replays"): (401, 403, 404, 201, 201, 201),
    ("get", f"{E}/replays/{{replay_id}}"): (401, 404, 404, 404, 404, 404),  # the teacher's
    ("delete", f"{E}/replays/{{replay_id}}"): (401, 403, 404, 404, 404, 404),  # the teacher's
    ("get", f"{E}/runs.jsonl"): READ,
    ("get", f"{E}/report.html"): (401, 409, 404, 409, 409, 409),  # nothing is done
    ("get", "/api/v1/runs"): PERSONAL,
    ("delete", "/api/v1/runs/{run_id}"): NOT_OWNED,
    ("post", "/api/v1/runs/logs"): (401, 403, 503, 503, 503, 503),  # as above
    ("get", "/api/v1/sessions"): PERSONAL,
    ("post", "/api/v1/sessions/attached"): (401, 403, 403, 403, 403, 403),  # on localhost only
    ("post", "/api/v1/sessions/attached/prepare"): (401, 403, 403, 403, 403, 403),  # as it
    ("get", "/api/v1/sessions/{session_id}"): NOT_OWNED,
    ("delete", "/api/v1/sessions/{session_id}"): NOT_OWNED,
    ("get", "/api/v1/me"): OPEN,
    ("get", "/api/v1/me/usage"): PERSONAL,
    ("get", "/api/v1/me/data"): PERSONAL,
    ("delete", "/api/v1/me/data"): (401, 403, 204, 204, 204, 204),
    ("get", "/api/v1/groups"): PERSONAL,
    ("post", "/api/v1/groups"): (401, 403, 403, 403, 403, 403),
    ("get", "/api/v1/groups/{group_id}"): (401, 403, 404, 200, 404, 404),
    ("patch", "/api/v1/groups/{group_id}"): (401, 403, 404, 403, 404, 404),
    ("delete", "/api/v1/groups/{group_id}"): (401, 403, 404, 403, 404, 404),
    ("delete", "/api/v1/groups/{group_id}/members/{username}"): (401, 403, 404, 403, 404, 404),
    ("post", "/api/v1/groups/{group_id}/invitations"): (401, 403, 404, 403, 404, 404),
    ("delete", "/api/v1/invitations/{invitation_id}"): NOT_OWNED,
    ("post", "/api/v1/actions/inspect"): (401, 403, 200, 200, 200, 200),
    ("post", "/api/v1/trees/xml"): OPEN,
    ("post", "/api/v1/trees/diagram"): PERSONAL,
    ("post", "/api/v1/python/format"): CONTAINED,
    ("post", "/api/v1/python/lint"): CONTAINED,
    ("get", "/api/v1/catalog/actions"): OPEN,
    ("get", "/api/v1/catalog/behaviours"): OPEN,
    ("get", "/api/v1/catalog/interfaces"): OPEN,
    ("get", "/api/v1/catalog/interfaces/{interface}"): OPEN,
    ("get", "/api/v1/catalog/nodes"): OPEN,
    ("get", "/api/v1/catalog/universes"): OPEN,
    ("get", "/api/v1/catalog/universes/{universe_id}/preview"): OPEN,
    ("get", "/api/v1/catalog/universes/{universe_id}/text"): OPEN,
    ("get", "/api/v1/catalog/robots"): OPEN,
    ("get", "/api/v1/catalog/robots/{robot_id}/preview"): OPEN,
    ("get", "/api/v1/catalog/robots/{robot_id}/config"): OPEN,
    ("get", "/api/v1/catalog/robots/{robot_id}/urdf"): OPEN,
    ("get", "/api/v1/catalog/templates"): OPEN,
    # JdeRobot's API of 2024 knows the user's own projects, by their names.
    ("get", "/tree_api/get_project_list/"): PERSONAL,
    ("get", "/tree_api/get_project_graph/?project_name=Robot"): OWN,
    ("get", "/tree_api/get_file_list/?project_name=Robot"): OWN,
    ("get", "/tree_api/get_file/?project_name=Robot&filename=Go.py"): OWN,
    ("get", "/tree_api/generate_app/?project_name=Robot"): (401, 403, 404, 404, 404, 422),
    ("get", "/tree_api/get_dockerized_app/?project_name=Robot"): (401, 403, 404, 404, 404, 422),
    ("get", "/tree_api/get_simplified_app/?project_name=Robot"): (401, 403, 404, 404, 404, 422),
    ("post", "/tree_api/create_project/"): (401, 403, 201, 201, 201, 201),
    ("post", "/tree_api/delete_project/"): OWN,
    ("post", "/tree_api/save_project_graph/"): OWN,
    ("post", "/tree_api/save_project/"): OWN,
    ("post", "/tree_api/create_file/"): (401, 403, 404, 404, 404, 201),
    ("post", "/tree_api/delete_file/"): OWN,
    ("post", "/tree_api/save_file/"): OWN,
}
BODIES = {
    ("post", "/api/v1/sessions/attached"): {"address": "robot.local"},
    ("post", "/api/v1/projects"): {"name": "Another"},
    ("patch", P): {"base_revision": 1, "description": "new"},
    ("post", f"{P}/changes"): {"files": [{"path": "new.txt", "base_revision": 0, "content": "x"}]},
    ("post", f"{P}/check"): {"files": []},
    ("post", f"{P}/distribution"): {"ros_distro": "kilted", "files": []},
    ("post", f"{P}/test"): {"files": []},
    ("post", f"{P}/test-with-python"): {"files": []},
    ("post", f"{P}/duplicate"): {},
    ("patch", f"{P}/revisions/{{number}}"): {"label": "first"},
    ("post", f"{P}/revisions/{{number}}/restore"): {},
    ("put", f"{P}/drafts/{{path}}"): {"base_revision": 1, "content": "typed"},
    ("post", f"{P}/shares"): {"name": "other", "role": "viewer"},
    ("post", f"{P}/transfer"): {"name": "editor"},
    ("put", f"{P}/shares/groups/{{group_id}}"): {"role": "viewer"},
    ("post", f"{P}/shares/links"): {},
    ("post", f"{P}/evaluations"): {"name": "room"},
    ("post", f"{E}/compare"): {"revision": 1},
    ("post", f"{E}/replays"): {"revision": 1, "seed": 3},
    ("post", f"{P}/runs"): {"run": "a1", "name": "First"},
    ("patch", f"{P}/runs/{{run_id}}"): {"name": "Mine now"},
    ("patch", "/api/v1/groups/{group_id}"): {"name": "Mine now"},
    ("post", "/api/v1/groups"): {"name": "Mine"},
    ("post", "/api/v1/groups/{group_id}/invitations"): {},
    ("post", "/api/v1/trees/xml"): {"diagram": TREE.decode()},
    ("post", "/api/v1/trees/diagram"): {
        "diagram": TREE.decode(),
        "xml": '<root BTCPP_format="4"><BehaviorTree ID="MainTree"/></root>',
    },
    ("post", "/api/v1/python/format"): {"source": "x=1", "path": "a.py"},
    ("post", "/api/v1/python/lint"): {"source": "x=1", "path": "a.py"},
    ("post", "/tree_api/create_project/"): {"project_name": "Another"},
    ("post", "/tree_api/delete_project/"): {"project_name": "Robot"},
    ("post", "/tree_api/save_project_graph/"): {"project_name": "Robot", "graph_json": TREE.decode()},
    ("post", "/tree_api/save_project/"): {"project_name": "Robot", "graph_json": TREE.decode()},
    ("post", "/tree_api/create_file/"): {"project_name": "Robot", "filename": "New.py"},
    ("post", "/tree_api/delete_file/"): {"project_name": "Robot", "filename": "Go.py"},
    ("post", "/tree_api/save_file/"): {"project_name": "Robot", "filename": "Go.py", "content": "x = 1"},
    ("post", "/api/v1/actions/inspect"): {"filename": "actions/A.py", "source": "class A: pass"},
}


@pytest.fixture
def world(person, monkeypatch):  # noqa: F811
    """One project, shared in every way, and the browsers of all roles."""
    people = {name: person(name) for name in ("other", "viewer", "editor", "owner", "teacher")}
    teacher = people["teacher"].user
    teacher.is_teacher = True
    teacher.save()
    owner = people["owner"].user
    files = {"trees/MainTree.json": TREE, "actions/Go.py": b"x = 0", "notes.txt": b"hello"}
    project = writes.create_project(files, acting_user=owner, name="Robot")
    group = groups.create("Class", acting_user=teacher)
    GroupMember.objects.create(group=group, user=people["viewer"].user, joined_at=project.created_at)
    GroupShare.objects.create(project=project, group=group, role=Role.VIEWER, created_at=project.created_at)
    memberships.share_with_person(project.id, "editor", Role.EDITOR, acting_user=owner)
    memberships.share_with_person(project.id, "teacher", Role.VIEWER, acting_user=owner)
    memberships.make_link(project.id, acting_user=owner, days=None)
    link = memberships.shares(project)["links"][0]
    people["nobody"], people["guest"] = Person(), Person()
    assert people["guest"].page(link["url"].partition(PUBLIC)[2]).status_code == 302
    session = Session.objects.create(
        project=project,
        user=teacher,
        state=SessionState.ENDED,
        ros_domain_id=7,
        created_at=project.created_at,
    )
    monkeypatch.setattr(session_writes, "workers", type("Idle", (), {"submit": lambda *_: None}))
    run = Run.objects.create(
        project=project,
        keeper=teacher,
        recorded_as="a1",
        start_s=0.0,
        length_s=1.0,
        size=0,
        thumbnail=b"<svg/>",
        thumbnail_type="image/svg+xml",
        created_at=project.created_at,
    )
    evaluation = _evaluation(project, teacher)
    invitation = invitations.invite(acting_user=teacher, group=group, days=1, max_uses=1)
    values = {
        "project_id": project.id,
        "path": "notes.txt",
        "interface": "geometry_msgs/msg/Twist",
        "number": 1,
        "username": "teacher",
        "universe_id": queries.universes()[0]["id"],
        "robot_id": queries.robots()[0]["id"],
        "group_id": group.id,
        "link_id": link["id"],
        "session_id": session.id,
        "run_id": run.id,
        "evaluation_id": evaluation.id,
        "seed": 3,
        "replay_id": evaluation.replays.get().id,
        "invitation_id": invitation.id,
    }
    return people, values


def _evaluation(project, teacher):
    """An evaluation with an outcome, and a replay that has failed."""
    at = {"created_at": project.created_at}
    own = {"name": "room", "revision": 1, "state": JobState.CANCELLED, "asked_at": project.created_at}
    evaluation = Evaluation.objects.create(project=project, user=teacher, **own, **at)
    cell = {"evaluation": evaluation, "revision": 1, "seed": 3}
    Outcome.objects.create(**cell, outcome="success", end_s=1.0, cpu_s=1.0, line='{"seed":3}', **at)
    Replay.objects.create(**cell, user=teacher, state=JobState.FAILED, **at)
    return evaluation


def ask(browser, method, path, values, body):
    address = path.format(**values)
    if path.endswith("/import"):
        upload = SimpleUploadedFile("new.xml", b'<root BTCPP_format="4"><BehaviorTree ID="T"/></root>')
        return browser.client.post(address, {"file": upload}).status_code
    if "/imports" in path:
        address += "?filename=a.urdf&kind=robot"
        return browser.client.post(address, b"<robot/>", "application/octet-stream").status_code
    data = {} if method in {"get"} or body is None else {"data": body, "content_type": "application/json"}
    response = getattr(browser.client, method)(address, **data)
    if response.streaming:
        response.getvalue()  # to the end of its file
    return response.status_code


def operations():
    """The endpoints of the OpenAPI document, and those of the older API, which is not in it."""
    named = sorted((method, path) for path, methods in document()["paths"].items() for method in methods)
    older = {call.__name__: call for call in (*views_legacy.READING, *views_legacy.WRITING)}
    for name, call in (older | views_legacy.ALIASES).items():
        named.append(("post" if call in views_legacy.WRITING else "get", f"/tree_api/{name}/"))
    return named


def test_the_policy_names_every_endpoint():
    named = {(method, path.partition("?")[0]) for method, path in POLICY}
    assert set(operations()) == named, set(operations()) ^ named


WRITES = sorted(key for key in POLICY if key[0] != "get")


def answers(people, values, method, path):
    found = {}
    for role in ROLES:
        body = BODIES.get((method, path))
        if path.endswith("/me/data") and people[role].user:
            body = {"username": role}
        found[role] = ask(people[role], method, path, values, body)
    return found


def policy(method, path):
    return dict(zip(ROLES, POLICY[method, path], strict=True))


def test_every_role_reads_what_the_policy_says(world):
    reads = [key for key in POLICY if key[0] == "get"]
    people, values = world
    assert {key: answers(people, values, *key) for key in reads} == {key: policy(*key) for key in reads}


@pytest.mark.parametrize(("method", "path"), WRITES, ids=lambda part: part.removeprefix("/api/v1"))
def test_every_role_writes_what_the_policy_says(method, path, world):
    assert answers(world[0], world[1], method, path) == policy(method, path)


def test_what_does_not_exist_answers_as_what_one_may_not_know_of(world):
    people, values = world
    missing = values | {"project_id": uuid.uuid4()}
    of_projects = [key for key in POLICY if "{project_id}" in key[1]]
    answers = {key: ask(people["other"], *key, missing, BODIES.get(key)) for key in of_projects}
    assert set(answers.values()) == {404}, answers
