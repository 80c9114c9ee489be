"""Benchmarks: the tracer beside others on the same machine, in the same run. `make bench`.

    scenes        meshes from formulas, of any number of triangles; a mesh from a file
    cameras       views of them, easy and hard; their rays as arrays
    peers         Mitsuba, Open3D, Embree and trimesh behind one interface; lucida: our side of it
    measure       times of calls, in turns
    report        tables and targets, as text, Markdown and JSON; plot: the picture of them
    tables        what is measured, a module each

The tests of this package (tests/project/test_benchmarks.py) need no peers and no stopwatch.
"""
