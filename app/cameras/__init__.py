"""The camera in the user's hands: editing its numbers, moving it, presets, passages, text forms.

Pure; travel.py is told of the window's frames. The camera itself, its formulas
and matrices, is renderer/camera.py.
"""
