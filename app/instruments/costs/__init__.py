"""The cost plot: the growth of both orders, counted."""
