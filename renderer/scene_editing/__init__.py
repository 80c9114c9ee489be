"""Editing scenes: each function takes a scene and gives another one; see changing.py.

    changing    one change: items (objects and lights by their keys), fields, what is built anew
    outline     what is in a scene, as a list
    objects     add, delete, duplicate, reorder, rename, hide, lock
    moving      matrices into and out of the file's numbers, for handles
    materials   shared ones and objects' own
    clipping    items as text: copy and paste
    documents   saved and unsaved: the file that a scene is from

Knows nothing of windows, nor of undo: a scene is a value, and the old one stays.
"""
