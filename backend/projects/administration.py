"""The administrator's page of projects: owners and sizes, but no content."""

from __future__ import annotations

from django.template.defaultfilters import filesizeformat

from backend.accounts.administration import ReadOnly, site
from backend.projects.models import Project


class Projects(ReadOnly):
    """All projects of the server."""

    list_display = ("name", "owner", "room", "revision", "updated_at", "archived_at", "deleted_at")
    list_select_related = ("owner",)
    search_fields = ("name", "owner__username")
    list_filter = ("archived_at", "deleted_at")
    ordering = ("-updated_at",)
    fields = ("id", "name", "owner", "room", "revision", "created_at", "updated_at")

    def room(self, row: Project) -> str:
        """Returns the size of the current files as text."""
        return str(filesizeformat(row.size))


site.register(Project, Projects)
