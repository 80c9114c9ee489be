"""The programs that the stepper shows, in Python and Julia.

Programs are written once, in Python, and julia.py translates them, so that they cannot diverge.
Only the Python of this project's own programs is translated: numbers and loops.
"""
