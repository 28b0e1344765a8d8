"""Imports worlds and maps of other programs into universes."""
