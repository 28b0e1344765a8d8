"""Addresses of the catalogue, below `/api/v1/`."""

from django.urls import path

from backend.catalog import views

urlpatterns = [
    path("catalog/nodes", views.Nodes.as_view()),
    path("catalog/universes", views.Universes.as_view()),
    path("catalog/universes/<str:universe_id>/preview", views.UniversePreview.as_view()),
    path("catalog/universes/<str:universe_id>/text", views.UniverseText.as_view()),
    path("catalog/robots", views.Robots.as_view()),
    path("catalog/robots/<str:robot_id>/preview", views.RobotPreview.as_view()),
    path("catalog/robots/<str:robot_id>/config", views.RobotConfig.as_view()),
    path("catalog/robots/<str:robot_id>/urdf", views.RobotUrdf.as_view()),
    path("catalog/behaviours", views.Behaviours.as_view()),
    path("catalog/templates", views.Templates.as_view()),
]
