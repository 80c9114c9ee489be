"""Explanations that several instruments share: formatted numbers, the terms of shading, programs in
Python and Julia. Knows no ImGui, no OpenGL, no window.
"""
