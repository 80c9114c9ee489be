"""What several instruments explain with: numbers as they are written, the terms of shading,
programs in Python, Julia and C. Knows no ImGui, no OpenGL, no window.
"""
