"""Files of tools are distinguished from those of a project."""

from __future__ import annotations

import pytest

from translator.foreign import is_of_tool, without_tools


@pytest.mark.parametrize(
    "path", [".git/config", "a/.vscode/tasks.json", "sub/.git", "GIT~1/hooks/x", ".GIT /x", ".g\u200cit"]
)
def test_a_file_in_a_hidden_folder_is_a_tools(path: str) -> None:
    assert is_of_tool(path)


def test_the_files_of_the_project_stay() -> None:
    files = {"actions/Go.py": b"1", ".gitignore": b"2", ".git/config": b"3", "a.git": b"4"}
    assert list(without_tools(files)) == ["actions/Go.py", ".gitignore", "a.git"]
