"""The number of queries of each endpoint; `query_budgets.json` is recorded with BT_STUDIO_RECORD=1."""

from __future__ import annotations

import json
import os
from pathlib import Path

from django.db import connection
from django.test.utils import CaptureQueriesContext

BUDGETS = Path(__file__).with_name("query_budgets.json")
CALLS = {
    "list_projects": ("GET", "projects", None),
    "list_offers": ("GET", "projects/offers", None),
    "get_project": ("GET", "projects/{id}", None),
    "save_changes": (
        "POST",
        "projects/{id}/changes",
        {"files": [{"path": "new.txt", "base_revision": 0, "content": "x"}]},
    ),
    "edit_project": ("PATCH", "projects/{id}", {"base_revision": 1, "description": "new"}),
    "check_project": ("POST", "projects/{id}/check", {"files": []}),
    "list_revisions": ("GET", "projects/{id}/revisions", None),
    "diff_revision": ("GET", "projects/{id}/revisions/1/diff", None),
    "download_file": ("GET", "projects/{id}/files/project.json", None),
    "save_draft": ("PUT", "projects/{id}/drafts/notes.txt", {"base_revision": 0, "content": "x"}),
    "list_drafts": ("GET", "projects/{id}/drafts", None),
    "export_project": ("GET", "projects/{id}/export", None),
    "get_shares": ("GET", "projects/{id}/shares", None),
    "list_groups": ("GET", "groups", None),
    "get_me": ("GET", "me", None),
    "get_my_usage": ("GET", "me/usage", None),
    "list_runs": ("GET", "projects/{id}/runs", None),
    "list_evaluations": ("GET", "projects/{id}/evaluations", None),
    "list_my_runs": ("GET", "runs", None),
    "list_sessions": ("GET", "sessions", None),
    "tree_api_list": ("GET", "/tree_api/get_project_list/", None),
    "tree_api_graph": ("GET", "/tree_api/get_project_graph/?project_name=tree_api_graph", None),
    "tree_api_files": ("GET", "/tree_api/get_file_list/?project_name=tree_api_files", None),
    "tree_api_file": ("GET", "/tree_api/get_file/?project_name=tree_api_file&filename=A1.py", None),
    "tree_api_save": (
        "POST",
        "/tree_api/save_file/",
        {"project_name": "tree_api_save", "filename": "A1.py", "content": "x"},
    ),
}


def test_no_endpoint_asks_the_database_more_often_than_its_budget_says(api):
    found = {}
    for name, (method, path, body) in CALLS.items():
        project = api.post("projects", {"name": name}, expect=201)
        files = [{"path": f"actions/A{n}.py", "base_revision": 0, "content": f"x = {n}\n"} for n in range(30)]
        if name != "edit_project":
            api.save(project["id"], *files)
        with CaptureQueriesContext(
            connection,
        ) as queries:
            api.call(method, path.format(id=project["id"]), body)
        real = [
            row
            for row in queries
            if not row["sql"].startswith(("SAVEPOINT", "RELEASE", "BEGIN", "SELECT pg_"))
        ]
        found[name] = len(real)
    if os.environ.get("BT_STUDIO_RECORD") == "1":
        BUDGETS.write_text(json.dumps(found, indent=2) + "\n")
    budgets = json.loads(BUDGETS.read_text())
    if connection.vendor == "postgresql":  # PostgreSQL is asked for several things in one query
        assert {name for name in found if found[name] > budgets[name]} == set()
    else:
        assert found == budgets
