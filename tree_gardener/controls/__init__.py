"""Nodes with several children, one rule in each module."""
