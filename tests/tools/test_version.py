"""The version is set in one place, and every copy of it is generated."""

from __future__ import annotations

from tests.tools.version import ROOT, copies, version


def test_every_copy_has_the_version_of_the_project():
    stale = [str(path.relative_to(ROOT)) for path, text in copies().items() if path.read_text() != text]
    assert stale == [], "run `make generate`"


def test_the_change_log_begins_with_this_version():
    headings = [line for line in (ROOT / "CHANGELOG.md").read_text().splitlines() if line.startswith("## ")]
    assert headings[0].split()[1] == version()


def test_the_engine_is_distributed_with_the_licence_of_the_project():
    assert (ROOT / "tree_gardener" / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
