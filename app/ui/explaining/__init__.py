"""Explanations that several instruments share: formatted numbers, symbols, formulas as text. Knows
no ImGui, no OpenGL, no window.
"""
