"""Heavy work of the web server in a few processes: bounded, fair to users, with a deadline.

A view hands its work to `pool.ask` and answers with a `deferred.Deferred`: the thread of the request is free
meanwhile. The possible jobs are in `jobs`; these functions know neither Django nor the database.
"""
