"""The classic wrong lines, as code that runs, and their diagnosis from a student's numbers.

catalogue  the lines and their mistakes, from the tables in catalogue/
program    lines of Python, some of them wrong, which are both run and shown
vectors    the functions that these lines may use
rays       the program for the viewing ray in a task's words
programs   the program for any task, and the values that its lines use
trials     the mistakes, one or two at once, that reproduce the given numbers
diagnosis  the explanation of wrong answers, in sentences
"""
