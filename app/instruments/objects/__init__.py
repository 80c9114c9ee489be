"""Editing the scene: select, move, change, add and delete its objects and lights.

renderer/editing/ defines the edits; here are the list, the inspector, the handles, and the
selection by a click in a view.
"""
