"""Benchmarks: the tracer beside others on the same machine, in the same run. `make bench`.

meshes        from formulas, of any number of triangles; interior: a hall, of the kind of Sponza
scenes        meshes under a name; a mesh from a file; scenes made of them
cameras       views of them, easy and hard; their rays as arrays
peers         Mitsuba and Open3D behind one interface; lucida: our side of it
embree        Embree in C++ (embree.cpp), compiled where its headers are
processes     a process of its own for each tracer
measure       times of calls, in turns
report        tables and targets, as text, Markdown and JSON
tables        what is measured, a module each
"""
