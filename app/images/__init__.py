"""Both images behind the window: made by the renderers, refined, compared, brought to the screen.

renderers  told the state, they keep both images up to date: progressive_ray, textures (raster)
agreement  whether they agree, compared in the background
shown      one image on its way to the screen; placement: where it stands there
"""
