"""Export of a scene as a glTF file.

export          checks the path, and writes the file
gltf_scene      the scene as a .glb file
glb_tree        the tree of that file, and its binary part
meshes          triangles as glTF needs them
"""

from .export import ENDINGS, check_export_path, export_scene

__all__ = ["ENDINGS", "check_export_path", "export_scene"]
