"""Runs heavy work of the web server in a few processes.

It has limits, a deadline, and a fair share for each user.

A view passes its work to `pool.ask` and returns a `deferred.Deferred`, so the thread of the request is free
meanwhile. The module `jobs` contains the functions; they use neither Django nor the database.
"""
