"""Single rays on the wide trees: closest hit and any hit."""
