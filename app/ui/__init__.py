"""The parts that panels are made of: theme, fields, rows, boxes, formulas, code. Knows no
instrument.
"""
