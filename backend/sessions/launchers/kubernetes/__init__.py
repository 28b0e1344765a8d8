"""Runs each executor in a pod of a Kubernetes cluster; executors outlive the web server.

bodies          makes pods of sessions and tools from the reviewed templates, and their secrets
ends            reads from a pod whether it is ready, and why it does not start or has ended
objects         knows all pods, or RayJobs, kept up to date by a thread that watches them
asking          makes and deletes objects, and says why one is refused
launcher        starts and ends pods
rayjob_bodies   makes RayJobs from their template, and reads what KubeRay says of them
rayjobs         starts and ends evaluations as RayJobs
"""
