"""Addresses of accounts, below `/api/v1/`."""

from django.urls import path

from backend.accounts.api import views

urlpatterns = [
    path("me", views.Me.as_view()),
    path("groups", views.Groups.as_view()),
    path("groups/<uuid:group_id>", views.OneGroup.as_view()),
    path("groups/<uuid:group_id>/members/<str:username>", views.Member.as_view()),
    path("groups/<uuid:group_id>/invitations", views.GroupInvitations.as_view()),
    path("invitations/<uuid:invitation_id>", views.OneInvitation.as_view()),
]
