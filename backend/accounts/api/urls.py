"""Paths of accounts, below `/api/v1/`."""

from __future__ import annotations

from django.urls import path

from backend.accounts.api import views
from backend.accounts.api.viewsets import resource_router

router = resource_router()
router.register("groups", views.Groups, basename="groups")

urlpatterns = [
    *router.urls,
    path("me", views.Me.as_view()),
    path("invitations/<uuid:invitation_id>", views.OneInvitation.as_view()),
]
