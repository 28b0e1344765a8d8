"""Further machines with Docker on which executors run: each has a keeper, a gate and a relay.

names        the addresses of hosts in the settings
authority    the private authority, and the certificates of web server and hosts
dial         streams to the sockets of a host, through its relay
contact      for how long a host has not been heard
"""
