"""What the window is to its instruments: what a view is, what an action is, where views are
docked.
"""
