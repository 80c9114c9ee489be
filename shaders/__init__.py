"""GLSL 3.30 core, one file a stage; chunks/ holds what stages share.

renderer/raster/sources.py reads them.
"""
