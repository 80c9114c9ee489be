"""The camera in the user's hands: editing its numbers, moving it, presets, transitions, text forms.

Pure; only travel.py knows frames. The camera itself, its formulas and matrices, is
renderer/camera.py.
"""
