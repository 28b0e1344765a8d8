"""Paths of the catalogue, below `/api/v1/`."""

from __future__ import annotations

from django.urls import path

from backend.accounts.api.viewsets import resource_router
from backend.catalog import views

router = resource_router()
router.register("catalog/interfaces", views.Interfaces, basename="interfaces")
router.register("catalog/universes", views.Universes, basename="universes")
router.register("catalog/robots", views.Robots, basename="robots")

urlpatterns = [
    *router.urls,
    path("catalog/actions", views.OfferedActions.as_view()),
    path("catalog/nodes", views.Nodes.as_view()),
    path("catalog/behaviours", views.Behaviours.as_view()),
    path("catalog/templates", views.Templates.as_view()),
]
