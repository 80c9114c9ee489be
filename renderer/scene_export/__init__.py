"""A scene and its camera in other programs' files: Mitsuba 3, pbrt-v4, glTF.

    export          the choice by the file's ending, and the files, written whole
    what            what a target takes and what it has not: said, never dropped in silence
    beside          the files next to a scene's, each once
    meshes          triangles as these programs want them, and PLY files
    materials       the nearest of their materials, images, and the lights' strengths
    lobe            our highlight as a table that Mitsuba reads
    checkers        checkers on texture coordinates

Knows nothing of renderers, pixels or windows.
"""

from renderer.scene_export.export import ENDINGS, check_export_path, export_scene

__all__ = ["ENDINGS", "check_export_path", "export_scene"]
