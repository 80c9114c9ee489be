"""The outside view: a camera, its rays and its picture, as lines in the world and on the screen.

extent      the extent of a scene; the outside camera that sees it and the other camera
frustum     the other camera's image plane and view volume in the world
diagram     the drawing, as lines, arrows, faces and labels in the world
camera_diagram: a camera; ray_drawing, simple_camera, growing: drawings for a lecture's builds
screen      the projection from the world to pixels and depths, with clipping
projected   the projected diagram
placing     positions for its labels where they cover nothing
paint       the input of the rasterizer's overlay, in the theme's colours
figure      lines, polygons and labels on a page; svg writes it, painting paints it
pixel_plane the image plane in pixels, with focal length and principal point
actions     the entries of its menu and the Instruments menu; tools draws its menu, axes and labels
"""
