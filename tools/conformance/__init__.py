"""Conformance: the formats of cameras, held against the real programs. `make conformance`.

    measured      how far apart the pixels were, and how far they may be
    cameras       random cameras and points, and the pixels that our camera says
    formats       a module each: what the real program says, of our files and of its own
    run           each format in a process of its own; what cannot be imported is left out
    report        the tables

A module of formats has check(job: Job) -> Checked; it raises PeerMissing where the real program is
not there. The tests of this package (tests/project/test_conformance.py) need none of them.
"""
