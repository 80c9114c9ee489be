"""The classic wrong lines, as code that runs, and what a student's numbers reveal about them.

catalogue       the lines and their mistakes, from the tables in catalogue/
program         lines of Python, some of them wrong, which are both run and shown
vectors, hits   the functions that these lines may use
rays            the program for the viewing ray in a task's words
value_programs  the programs for other kinds of function
render          both loops: the ray's lines, then the nearest object
candidates      the mistakes, one or two at once, that reproduce the given numbers
ray_facts       what is correct about wrong rays, and where
diagnosis       the combined result; ray_diagnosis for rays, value_diagnosis for other answers
"""
