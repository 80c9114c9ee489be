"""The outside view's geometry: a camera and its rays as lines in the world, and on the screen.

    extent      how far a scene reaches; the outside camera that sees it and the other camera
    solid       the other camera's image plane and view volume in the world
    diagram     what is drawn, as lines, arrows, faces and labels in the world
    screen      from the world to pixels and depths, clipped
    projected   the diagram there
    hits        where viewing rays end, asked for without waiting
    switches    what can be switched, in words
    paint       as the rasterizer's overlay takes it, in the theme's colours
    sketch      all that a vector drawing is made from; vector, outlines, hidden, standing: what
                becomes of lines, objects, what is behind, the live image; svg, bitmap: as files

Pure but for paint: nothing else here knows of windows, themes or OpenGL.
"""
