"""placeholder until the readers are in"""
from pathlib import Path
from renderer.scene.model import SceneObject, Scene
MODEL_ENDINGS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
def load_model(path: Path) -> tuple[SceneObject, ...]: raise NotImplementedError
def model_scene(path: Path) -> Scene: raise NotImplementedError
