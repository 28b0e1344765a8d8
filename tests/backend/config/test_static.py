"""The built front end."""

from __future__ import annotations

import gzip

import pytest
from django.http import HttpResponse
from django.test import RequestFactory

from backend.config import static
from tests.backend.accounts.conftest import Person


def test_without_a_built_page_the_server_says_so(api, settings, tmp_path, monkeypatch):
    monkeypatch.setattr(type(settings.ENVIRONMENT), "frontend_dir", tmp_path, raising=False)
    page = api.client.get("/")
    assert page.status_code in {200, 503}
    assert static.page.__doc__


def test_on_a_team_server_a_stranger_signs_in_first(team):
    answer = Person().page("/projects/3f2504e0-4f89-41d3-9a0c-000000000001")
    assert answer.status_code == 302
    assert answer.headers["Location"].startswith("/accounts/login/?next=%2Fprojects")


@pytest.fixture
def built(tmp_path, settings):
    """A server of a front end with one script and its compressed forms."""
    settings.WHITENOISE_ROOT = str(tmp_path)
    script = b"export const answer = 42;\n" * 100
    (tmp_path / "assets").mkdir()
    path = tmp_path / "assets" / "index-ABC.js"
    path.write_bytes(script)
    path.with_name("index-ABC.js.gz").write_bytes(gzip.compress(script))
    path.with_name("index-ABC.js.br").write_bytes(b"a brotli stream")
    return script, static.FrontEndFiles(lambda _request: HttpResponse("the page", status=404))


def asked(server, method="get", path="/assets/index-ABC.js", **headers):
    return server(getattr(RequestFactory(headers=headers), method)(path))


def test_a_file_is_sent_as_small_as_the_browser_reads_it(built):
    script, server = built
    brotli = asked(server, accept_encoding="gzip, deflate, br, zstd")
    zipped = asked(server, accept_encoding="gzip")
    plain = asked(server)
    assert (brotli.headers["Content-Encoding"], brotli.content) == ("br", b"a brotli stream")
    assert (zipped.headers["Content-Encoding"], gzip.decompress(zipped.content)) == ("gzip", script)
    assert ("Content-Encoding" in plain.headers, plain.content) == (False, script)
    for answer in (brotli, zipped, plain):
        assert answer.headers["Vary"] == "Accept-Encoding"
        assert answer.headers["Content-Type"].startswith("text/javascript")
        assert "immutable" in answer.headers["Cache-Control"]
        assert answer.headers["Content-Length"] == str(len(answer.content))


def test_a_compressed_file_is_checked_by_its_tag_and_asked_for_without_its_body(built):
    _, server = built
    first = asked(server, accept_encoding="br")
    again = asked(server, accept_encoding="br", if_none_match=first.headers["ETag"])
    head = asked(server, "head", accept_encoding="br")
    assert (again.status_code, again.content) == (304, b"")
    assert (head.content, head.headers["Content-Length"]) == (b"", first.headers["Content-Length"])


def test_a_part_of_a_file_is_a_part_of_what_is_sent(built):
    script, server = built
    part = asked(server, range="bytes=7-11")
    assert (part.status_code, part.content) == (206, script[7:12])
    small = asked(server, accept_encoding="br", range="bytes=2-7")
    assert (small.headers["Content-Encoding"], small.content) == ("br", b"brotli")


def test_a_compressed_form_is_no_file_of_its_own(built):
    _, server = built
    assert asked(server, path="/assets/index-ABC.js.br").status_code == 404


def test_the_build_compresses_each_script_and_style_sheet(settings):
    """This applies to the build that a browser gets: on localhost, and in the image of a team's server."""
    assets = settings.ENVIRONMENT.frontend_dir / "assets"
    files = [path for path in assets.iterdir() if path.suffix in {".js", ".css"}]
    large = [path for path in files if path.stat().st_size > 1024]
    assert large
    for path in large:
        zipped = path.with_name(f"{path.name}.gz")
        assert gzip.decompress(zipped.read_bytes()) == path.read_bytes()
        assert path.with_name(f"{path.name}.br").stat().st_size < zipped.stat().st_size
