"""The camera as the user changes it: editing its numbers, moving it, presets, transitions, text
forms.

Pure; only travel.py depends on frames. renderer/camera/camera.py has the camera itself, its
formulas and matrices.
"""
