"""Addresses of accounts, below `/api/v1/`."""

from django.urls import path

from backend.accounts.views import Me

urlpatterns = [path("me", Me.as_view())]
