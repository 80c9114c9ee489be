"""The windows inside the window, one module each: what they show and what they let one do.

    base      what a view is, and what it may ask of the window around it
    camera    the camera's panel
    pair      the raster and the ray image
    probe     everything along one pixel's viewing ray, in formulas
    stepper   object order and image order, line by line
    costs     both renderers' times against triangles and pixels
    laboratory  the current image in the representations that the lecture names
    lecture   the guided lecture: a column of text beside the views of a step

To add one: a module with a class that derives from base.View, a line in VIEWS of window.py, and
its place in the layouts of layout.py. The menus, the layouts and the shortcut sheet take it up.
"""
