"""Browsers are redirected to the object store for whole files, and nobody else is."""

from __future__ import annotations

import base64
import random

import pytest
import requests
from django.test import RequestFactory

from backend.core.objects.downloads import is_direct
from backend.ingress.middleware import headers_of_all
from backend.projects.models import Blob

LARGE = random.Random(4).randbytes((1 << 20) + 1)  # noqa: S311


@pytest.fixture
def public(objects, settings_of):
    settings_of(**objects.settings, object_store_public=objects.origin)
    return objects


def asked(filename, *, method="GET", **headers):
    headers = {"sec-fetch-dest": "empty"} | headers
    return is_direct(RequestFactory(headers=headers).generic(method, "/"), filename)


def test_browsers_are_redirected_for_whole_files(public):
    assert asked("a.bin")
    assert asked("a.bin", **{"sec-fetch-dest": "document"})
    assert not asked("a.bin", **{"sec-fetch-dest": "image"})
    assert not asked("a.bin", **{"sec-fetch-dest": ""})
    assert not asked("a.bin", range="bytes=0-9")
    assert not asked("a.bin", method="HEAD")


@pytest.mark.parametrize("name", ["a.html", "a.SVG", "b/c.xhtml", "a.b.htm", "a.svgz", "a.html."])
def test_never_for_what_a_browser_displays_as_a_page(public, name):
    assert not asked(name)


def test_without_the_setting_nobody_is(objects):
    assert not asked("a.bin")
    assert "connect-src 'self';" in headers_of_all()["Content-Security-Policy"]


def test_the_policy_of_pages_admits_this_origin_alone(public):
    policy = headers_of_all()["Content-Security-Policy"]
    assert f"connect-src 'self' {public.origin};" in policy
    assert policy.count(public.origin) == 1


def test_the_address_gives_one_file_and_needs_the_right_to_read_it(api, project, public):
    content = base64.b64encode(LARGE).decode()
    files = [{"path": path, "base_revision": 0, "content_base64": content} for path in ("a.bin", "a.svg")]
    api.save(project["id"], *files, {"path": "small.bin", "base_revision": 0, "content": "small"})
    browser = {"sec-fetch-dest": "empty", "sec-fetch-site": "same-origin"}
    place = f"projects/{project['id']}/files"
    api.get(f"{place}/a.bin", expect=302, **browser)
    address = api.response.headers["Location"]
    assert api.response.headers["Cache-Control"] == "private, no-store"
    answer = requests.get(address, timeout=60)
    assert (answer.content, answer.headers["Content-Type"]) == (LARGE, "application/octet-stream")
    assert answer.headers["Content-Disposition"].startswith("attachment;")
    assert Blob.objects.exclude(stored_at=None).get().stored_at in address
    assert api.get(f"{place}/a.svg", **browser) == LARGE
    assert api.get(f"{place}/small.bin", **browser) == b"small"
    assert api.get(f"{place}/a.bin") == LARGE
    api.get(f"{place}/none.bin", expect=404, **browser)
    api.client.cookies.clear()
    api.get(f"{place}/a.bin", expect=403, **browser)
