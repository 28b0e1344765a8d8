"""Runs each executor in a pod of a Kubernetes cluster; executors outlive the web server.

bodies    makes pods of sessions and tools from the reviewed templates, and their secrets
ends      reads from a pod whether it is ready, and why it does not start or has ended
pods      knows all pods, kept up to date by a thread that watches them
launcher  starts and ends them
"""
