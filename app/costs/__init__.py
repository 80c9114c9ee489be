"""The cost plot: what each of both orders grows with, counted and measured."""
