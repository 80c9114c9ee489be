"""Raster against ray: where two images differ, and why."""
