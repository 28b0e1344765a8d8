"""Every declared Python dependency is used."""

from __future__ import annotations

from tests.tools.dependencies import (
    PRODUCT,
    ROOT,
    USED_BY,
    declared,
    imported,
    normal,
    of_the_page,
    shipped,
    used_elsewhere,
)


def test_every_declared_package_is_imported_or_used():
    used = imported()
    unused = [name for name in declared() if name not in used and not used_elsewhere(name)]
    assert unused == [], "remove them from pyproject.toml, or name their use in tests/tools/dependencies.py"


def test_every_package_that_users_install_is_used_by_the_product():
    used = imported(PRODUCT)
    unused = [name for name in shipped() if name not in used and name not in USED_BY]
    assert unused == [], "move them to the group dev"


def test_the_table_of_uses_holds_only_packages_that_no_source_imports():
    """The product's own sources, for a package that users install: tests may import that as well."""
    assert sorted(set(USED_BY) - set(declared())) == []
    for_users = set(shipped())
    assert sorted(set(USED_BY) & for_users & imported(PRODUCT)) == []
    assert sorted((set(USED_BY) - for_users) & imported()) == []


def test_the_page_of_dependencies_names_every_package():
    page = normal((ROOT / "docs" / "explanation" / "dependencies.md").read_text(encoding="utf-8"))
    assert [name for name in declared() if name not in page] == []


def test_it_names_every_package_of_the_page():
    page = (ROOT / "docs" / "explanation" / "dependencies.md").read_text(encoding="utf-8")
    missing = [
        name
        for name in of_the_page()
        if f"`{name}`" not in page and f"`{name.partition('/')[0]}/*`" not in page
    ]
    assert missing == []
