"""Export of a scene to other programs' files: Mitsuba 3, pbrt-v4, glTF.

export          selects the writer by the file's ending, and writes all files or none
what            the files of an export, and the list of what a target lacks
meshes          triangles as these programs need them, and PLY files
materials       the nearest of their materials, images, and the lights' strengths
lobe            Lucida's highlight as a table that Mitsuba reads
checkers        checkers on texture coordinates
"""

from renderer.scene_export.export import ENDINGS, check_export_path, export_scene

__all__ = ["ENDINGS", "check_export_path", "export_scene"]
