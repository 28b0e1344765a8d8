"""A name of a lazy package is imported when it is asked for, and not hidden by a submodule of its name."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

import translator
import tree_gardener
import tree_gardener.groot
from tree_gardener.lazy import import_names, lazy_package

ROOT = Path(__file__).parents[2]
PACKAGES = (translator, tree_gardener, tree_gardener.groot)


def said(code: str) -> str:
    """Returns the output of a fresh interpreter."""
    return subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.strip()


@pytest.mark.parametrize("package", PACKAGES, ids=lambda package: package.__name__)
def test_every_public_name_is_there_and_listed(package: ModuleType) -> None:
    import_names(package)
    assert {*package.__all__} <= {*dir(package)}
    assert not any(isinstance(getattr(package, name), ModuleType) for name in package.__all__)


def test_one_name_loads_its_module_alone() -> None:
    loaded = said(
        "import sys\nfrom tree_gardener import Status\nfrom translator import Severity\n"
        "print('tree_gardener.tree' in sys.modules, 'translator.check' in sys.modules, Status, Severity)"
    )
    assert loaded.startswith("False False")


def test_who_follows_another_tree_loads_neither_the_engine_nor_the_checks() -> None:
    loaded = said("import sys, executor.attached.process\nprint(*sys.modules)").split()
    heavy = {"tree_gardener.tree", "tree_gardener.groot.publisher", "translator.check", "translator.export"}
    assert heavy & {*loaded} == set()
    assert "translator.importer" in loaded


def test_a_submodule_does_not_hide_the_function_of_its_name() -> None:
    for package, name in (("translator", "check"), ("tree_gardener", "backup")):
        before = f"import {package}.{name}\nfrom {package} import {name}\nprint(callable({name}))"
        after = f"from {package} import {name}\nimport {package}.{name}\nprint(callable({package}.{name}))"
        assert (said(before), said(after)) == ("True", "True")


def test_a_name_can_be_replaced_and_an_unknown_one_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    package = ModuleType("a_lazy_package")
    monkeypatch.setitem(sys.modules, "a_lazy_package", package)
    lazy_package("a_lazy_package", {"math": "pi tau", "json": "loads"})
    found: dict[str, object] = vars(package)
    assert "tau" not in found
    assert package.tau > 6
    assert "tau" in found
    setattr(package, "loads", len)  # noqa: B010 - as a test of another package does
    assert vars(package)["loads"] is len
    with pytest.raises(AttributeError):
        package.nothing  # noqa: B018
