"""Templates of new projects."""

from __future__ import annotations

import pytest

from backend.core.problems import InvalidInputError
from backend.projects.documents.templates import EMPTY, files_of, templates


def test_the_empty_project_comes_first_and_all_have_files(settings_of) -> None:
    found = templates()
    assert found[0].id == EMPTY
    assert len(found) > 1
    for template in found:
        assert "project.json" in files_of(template.id)
        assert template.root_diagram is not None
        assert not [path for path in files_of(template.id) if "__pycache__" in path]


@pytest.mark.parametrize("name", ["no", "..", "../backend", ""])
def test_another_name_is_refused_with_those_that_exist(name: str) -> None:
    with pytest.raises(InvalidInputError) as refused:
        files_of(name)
    assert EMPTY in refused.value.hint
