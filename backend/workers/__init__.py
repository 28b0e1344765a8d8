"""Runs heavy work of the web server in a few processes, with limits, fairness to users, and a deadline.

A view passes its work to `pool.ask` and returns a `deferred.Deferred`, so the thread of the request is free
meanwhile. The module `jobs` has the functions; they use neither Django nor the database.
"""
