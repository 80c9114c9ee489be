"""Single rays on the wide trees: the closest hit of each, and whether there is any."""
