"""Both images behind the window: made by the renderers, refined, compared, brought to the screen.

renderers  keep both images up to date with the state: progressive_ray, textures (raster)
agreement  compares them in the background
shown      brings one image to the screen; placement: its place there
"""
