"""The parts that views and panels are made of: theme, fields, formulas, text, background work.

view.py, action.py and instrument.py say what an instrument gives the window.
"""
