"""The outside view: a camera, its rays and its picture, as lines in the world and on the screen.

extent      how far a scene reaches; the outside camera that sees it and the other camera
frustum     the other camera's image plane and view volume in the world
diagram     what is drawn, as lines, arrows, faces and labels in the world
ray_drawing, simple_camera, growing: drawings that grow with a lecture's builds
screen      from the world to pixels and depths, clipped
projected   the diagram there
placing     its labels, where they cover nothing
pixel_plane the image plane in pixels, to be dragged
hits        where viewing rays end, asked for without waiting
switches    the switches, in words
paint       the input of the rasterizer's overlay, in the theme's colours
sketch      the inputs of a vector drawing; vector, outlines, occlusion, image_bitmap: its lines,
            objects, hidden parts, live image; svg, bitmap, vector_painting: its painters
"""
