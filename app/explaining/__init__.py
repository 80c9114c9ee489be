"""Explanations that several instruments share: formatted numbers, the terms of shading, programs in
Python, Julia and C. Knows no ImGui, no OpenGL, no window.
"""
