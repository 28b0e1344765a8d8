"""Reads from a recording the facts of its run as a whole, for lists of runs, and states of its world.

facts     times, result, last picture, trail and tree, in one pass over the records
keyframes the state of the world at a moment, for a run that goes back
places    where the bodies of the world are, seen from above
apart     the reading in a child with limits; the only way in for recordings of others
"""
