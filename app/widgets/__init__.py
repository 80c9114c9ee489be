"""What panels are made of: the look, fields, rows, boxes, formulas, code. Knows no instrument."""
