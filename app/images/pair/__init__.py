"""The raster and the ray image, side by side: their views, toolbar, mouse, pixel grid and marks."""
