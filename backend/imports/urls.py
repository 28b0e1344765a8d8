"""Paths of imports, below `/api/v1/`."""

from __future__ import annotations

from backend.accounts.api.viewsets import resource_router
from backend.imports import robots, trees, views
from backend.projects.documents import checking, python_trees

checking.look_at_robots_by(robots.look)
python_trees.read_by(trees.read)
router = resource_router()
router.register("projects/<uuid:project_id>/imports", views.Imports, basename="imports")

urlpatterns = router.urls
