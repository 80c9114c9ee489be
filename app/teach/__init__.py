"""The teaching instruments' cores: what they compute and say. Knows no ImGui, no OpenGL, no window.

A view (app/views/) shows each of them.
"""
