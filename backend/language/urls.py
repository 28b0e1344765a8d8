"""Paths of the support for Python, below `/api/v1/`; the socket is in `consumers`."""

from __future__ import annotations

from django.urls import path

from backend.language import views

urlpatterns = [
    path("python/format", views.Format.as_view()),
    path("python/lint", views.Lint.as_view()),
    path("projects/<uuid:project_id>/test-with-python", views.TestWithPython.as_view()),
]
