"""Runs each executor in a pod of a Kubernetes cluster; executors outlive the web server.

bodies    makes the pod of a session from the reviewed template, and its secret
ends      reads from a pod whether it is ready, and why it does not start or has ended
pods      knows all pods of sessions, kept up to date by a thread that watches them
launcher  starts and ends them
"""
