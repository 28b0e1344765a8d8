"""Paths of projects, below `/api/v1/`."""

from __future__ import annotations

from django.urls import path

from backend.accounts.api.viewsets import resource_router
from backend.projects.api import (
    views,
    views_files,
    views_mine,
    views_offers,
    views_revisions,
    views_sharing,
    views_trees,
)

ONE = "projects/<uuid:project_id>"

router = resource_router()
router.register("projects", views.Projects, basename="projects")
router.register("projects", views_files.ProjectFiles, basename="project-files")
router.register(f"{ONE}/revisions", views_revisions.Revisions, basename="revisions")
router.register(f"{ONE}/drafts", views_revisions.Drafts, basename="drafts")
router.register(f"{ONE}/shares", views_sharing.Shares, basename="shares")
router.register("me", views_mine.Mine, basename="mine")
router.register("trees", views_trees.Trees, basename="trees")

urlpatterns = [
    *router.urls,
    path(f"{ONE}/transfer", views_sharing.Transfer.as_view()),
    path("projects/offers", views_offers.Offers.as_view()),
    path("actions/inspect", views.InspectAction.as_view()),
]
