"""The classic wrong lines, as code that runs, and what a student's numbers tell of them.

program     lines of Python of which some may be wrong: run, and shown
rays        the viewing ray: its lines, and all that is written instead
vectors     what those lines may use
"""
