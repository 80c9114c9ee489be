"""Both images behind the window: made by the renderers, refined, compared, shown on the screen.

renderers  keep both images up to date with the state: progressive_ray, textures (raster)
agreement  compares them in the background
shown      draws one image for the screen; placement: its place there
"""
