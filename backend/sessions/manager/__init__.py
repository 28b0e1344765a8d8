"""Connections from the web server to the managers of sessions.

address      where it listens, and how connections to it are opened
certificate  what encrypts connections to one on another machine
sockets      its websockets, for pages and for the watch over sessions
holds        whether a debugger holds its tree
"""
