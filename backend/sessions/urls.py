"""Paths of sessions, below `/api/v1/`; the sockets are in `consumers`."""

from django.urls import path

from backend.sessions import views

urlpatterns = [
    path("projects/<uuid:project_id>/session", views.ProjectSession.as_view()),
    path("sessions", views.OwnSessions.as_view()),
    path("sessions/attached", views.AttachedSessions.as_view()),
    path("sessions/attached/prepare", views.PreparedAttachedSession.as_view()),
    path("sessions/<uuid:session_id>", views.OneSession.as_view()),
]
