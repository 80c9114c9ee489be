"""The classic wrong lines, as code that runs, and what a student's numbers tell of them.

program         lines of Python of which some may be wrong: run, and shown
vectors         what those lines may use
rays            the viewing ray in a task's words: viewport, basis, pixels, bodies are its parts
hits, images    spheres, triangles, the nearest object; gray, bits, offsets
render          both loops: the ray's lines, then the nearest object
candidates      which mistakes, one or two at once, give the numbers that came back
fitted          the camera that was written; differences: from the one that was asked for, in words,
                told as_basis or as_viewport, whichever is shorter; difference: what both use
ray_facts       what of wrong rays is right, and where
diagnosis       what is told of it all; ray_diagnosis, value_diagnosis: of rays, of other answers
value_kinds     which kind of function has which program
"""
