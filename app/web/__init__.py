"""Self-contained HTML pages: a scene with its camera, both images and the outside view.

modules/ holds the plain ES modules that a page runs, and page.css.
"""

ENDINGS = (".html", ".htm")
