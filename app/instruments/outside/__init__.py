"""The outside view: a camera, its rays and its picture, as lines in the world and on the screen.

extent      how far a scene reaches; the outside camera that sees it and the other camera
frustum     the other camera's image plane and view volume in the world
diagram     what is drawn, as lines, arrows, faces and labels in the world
camera_diagram: a camera; ray_drawing, simple_camera, growing: what grows with a lecture's builds
screen      from the world to pixels and depths, clipped
projected   the diagram there
placing     its labels, where they cover nothing
paint       the input of the rasterizer's overlay, in the theme's colours
figure      lines, polygons and labels on a page; svg writes it, painting paints it
pixel_plane the image plane in pixels, to be dragged
actions     what its menu and the menu Instruments do; tools draws its menu, the axes and the labels
"""
