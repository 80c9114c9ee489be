"""The scene in hand: its objects and lights are chosen, moved, changed, added and taken away.

What an edit is, is renderer/scene_editing/'s; here are the list, the inspector, the handles, and
what a click in a view chooses.
"""
