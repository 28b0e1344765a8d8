"""Open sockets and running robots end when the user loses the right to them."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager, suppress
from typing import Any
from uuid import UUID

import pytest
from asgiref.sync import sync_to_async
from django.conf import settings
from django.db import connections
from django.utils import timezone

from backend.accounts import rights
from backend.accounts.models import User
from backend.ingress.sockets import FORBIDDEN, SIGNED_OUT, Route, serve
from backend.projects.api.consumers import ADDRESS, NO_SUCH_PROJECT, may_read, may_write, serve_notices
from backend.sessions.choices import SessionState
from backend.sessions.lifecycle import writes as session_writes
from backend.sessions.models import Session
from tests.backend.accounts.conftest import PUBLIC, Person

pytestmark = pytest.mark.django_db(transaction=True)


def shared_project(owner, **share):
    made = owner.post("projects", {"name": "Robot"}, expect=201)["id"]
    if share:
        owner.post(f"projects/{made}/shares", share)
    return made


def scope_of(browser, path):
    cookies = "; ".join(f"{name}={morsel.value}" for name, morsel in browser.client.cookies.items())
    headers = {"host": PUBLIC, "origin": f"http://{PUBLIC}", "cookie": cookies}
    return {
        "type": "websocket",
        "path": path,
        "query_string": b"",
        "headers": [(name.encode(), value.encode()) for name, value in headers.items()],
    }


def closed_after(browser, project, deed):
    """Returns the code with which the socket of an open project closes after an action."""

    async def listen():
        heard: asyncio.Queue[Any] = asyncio.Queue()
        said: asyncio.Queue[Any] = asyncio.Queue()
        said.put_nowait({"type": "websocket.connect"})
        scope = scope_of(browser, f"/ws/projects/{project}/notices")
        serving = asyncio.create_task(
            serve({ADDRESS: Route(serve_notices, may_read)}, scope, said.get, heard.put)
        )
        assert (await heard.get())["type"] == "websocket.accept"
        assert '"revision"' in (await heard.get())["text"]
        await sync_to_async(deed)()
        told = await heard.get()
        await serving
        await sync_to_async(connections.close_all)()  # of the serving thread, since nothing else closes them
        return told["type"], told["code"]

    kind, code = asyncio.run(listen())
    assert kind == "websocket.close"
    return code


def test_a_user_who_may_not_use_a_socket_gets_the_reason(person):
    owner, friend = person("olga"), person("fred")
    one = shared_project(owner, name="fred", role="viewer")

    async def written(call, receive, send):
        await sync_to_async(may_write)(UUID(call.address[1]), call.user)

    async def code():
        heard: asyncio.Queue[Any] = asyncio.Queue()
        said: asyncio.Queue[Any] = asyncio.Queue()
        said.put_nowait({"type": "websocket.connect"})
        routes = {ADDRESS: Route(written, may_write)}
        await serve(routes, scope_of(friend, f"/ws/projects/{one}/notices"), said.get, heard.put)
        await sync_to_async(connections.close_all)()
        assert heard.get_nowait()["type"] == "websocket.accept"
        return heard.get_nowait()["code"]

    assert asyncio.run(code()) == FORBIDDEN


def test_a_guest_is_refused_at_once_though_the_watcher_loses_its_cancellation(person, monkeypatch):
    owner, guest = person("olga"), Person()
    one = shared_project(owner)
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]
    guest.page(link["url"].partition(PUBLIC)[2])
    monkeypatch.setattr(rights, "RECHECK_S", 1e6)
    watching = asyncio.Event()

    @asynccontextmanager
    async def deaf():
        watching.set()
        with suppress(asyncio.CancelledError):
            await asyncio.Event().wait()
        yield asyncio.Event().wait

    monkeypatch.setattr(rights, "notices", deaf)

    async def written(call, receive, send):
        await watching.wait()
        await sync_to_async(may_write)(UUID(call.address[1]), call.user)

    async def code():
        heard: asyncio.Queue[Any] = asyncio.Queue()
        said: asyncio.Queue[Any] = asyncio.Queue()
        said.put_nowait({"type": "websocket.connect"})
        routes = {ADDRESS: Route(written, may_write)}
        await serve(routes, scope_of(guest, f"/ws/projects/{one}/notices"), said.get, heard.put)
        await sync_to_async(connections.close_all)()
        assert heard.get_nowait()["type"] == "websocket.accept"
        return heard.get_nowait()["code"]

    assert asyncio.run(code()) == FORBIDDEN


def test_a_user_who_is_removed_from_a_project_gets_no_more_of_it(person):
    owner, friend = person("olga"), person("fred")
    one = shared_project(owner, name="fred", role="viewer")
    deed = lambda: owner.delete(f"projects/{one}/shares/people/fred")  # noqa: E731
    assert closed_after(friend, one, deed) == NO_SUCH_PROJECT


def test_a_link_that_is_taken_back_ends_what_it_opened(person):
    owner = person("olga")
    one = shared_project(owner)
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]
    guest = Person()
    guest.page(link["url"].partition(PUBLIC)[2])
    deed = lambda: owner.delete(f"projects/{one}/shares/links/{link['id']}")  # noqa: E731
    assert closed_after(guest, one, deed) == NO_SUCH_PROJECT


def test_a_user_who_leaves_a_group_leaves_what_was_shared_with_it(person):
    teacher, sam = person("tina", is_teacher=True), person("sam")
    group = teacher.post("groups", {"name": "Robotics"}, expect=201)["id"]
    link = teacher.post(f"groups/{group}/invitations", expect=201)["url"]
    sam.form(link.partition(PUBLIC)[2])
    one = shared_project(teacher)
    teacher.put(f"projects/{one}/shares/groups/{group}", {"role": "viewer"})
    deed = lambda: sam.delete(f"groups/{group}/members/sam")  # noqa: E731
    assert closed_after(sam, one, deed) == NO_SUCH_PROJECT


def test_signing_out_or_being_deactivated_ends_what_is_open(person):
    olga = person("olga")
    one = shared_project(olga)
    assert closed_after(olga, one, olga.client.logout) == SIGNED_OUT
    olga.quick()

    def deactivate():
        user = User.objects.get(username="olga")
        user.is_active = False
        user.save(update_fields=["is_active"])

    assert closed_after(olga, one, deactivate) == SIGNED_OUT
    assert settings.SESSION_COOKIE_NAME in olga.client.cookies


def test_a_robot_does_not_outlive_the_right_to_run_it(person, monkeypatch):
    ended = []
    workers = type("Now", (), {"submit": lambda _, call, session, why="": ended.append((session.user, why))})
    monkeypatch.setattr(session_writes, "workers", workers)
    owner, friend = person("olga"), person("fred")
    one = shared_project(owner, name="fred", role="viewer")
    Session.objects.bulk_create(
        Session(
            project_id=one,
            user=browser.user,
            state=SessionState.READY,
            ros_domain_id=domain,
            created_at=timezone.now(),
        )
        for domain, browser in enumerate((owner, friend), start=70)
    )
    owner.post(f"projects/{one}/shares", {"name": "fred", "role": "editor"})
    assert ended == []
    owner.delete(f"projects/{one}/shares/people/fred")
    assert ended == [(friend.user, "You may no longer run this project.")]
