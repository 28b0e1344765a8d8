"""Executors that are started ahead, so that a session starts at once.

claims  gives one to a session
pool    keeps as many as the administrator wants, and removes those that are old or left over
"""
