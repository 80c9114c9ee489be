"""Random edits, one after another, with undo and redo among them: both renderers follow and agree,
and what is saved is what was edited, in its author's words."""

from __future__ import annotations

import numpy as np
import pytest
from random_edits import EDITS, SCENE, TENT, check_same, edited

from lucida import Rasterizer, Tracer
from lucida.renderer.camera.camera import Camera
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.editing import changing, documents, objects
from lucida.renderer.files import load_scene
from lucida.renderer.scene import Scene, flatten
from lucida.renderer.scene.model import View

SIZE = (24, 16)
SEQUENCES, EDITS_EACH = 30, 4
VIEW = View(Camera.look_at((0.3, 1.2, 5.0), (0, 0, 0), fov_y_deg=40.0, aspect=1.5), fit=True)


@pytest.fixture
def start(tmp_path):
    (tmp_path / "tent.obj").write_text(TENT)
    (tmp_path / "scene.toml").write_text(SCENE)
    return load_scene(tmp_path / "scene.toml")


def sequence(seed: int, start: Scene) -> tuple[list[str], list[Scene]]:
    """Return the edits, and the scenes that they make, one after another."""
    rng = np.random.default_rng([20261123, seed])
    history, at, shown, done = [start], 0, [start], []
    for _ in range(EDITS_EACH):
        if rng.random() < 0.2:
            at = int(rng.integers(len(history)))
            name, scene = f"to {at}", history[at]
        else:
            name, scene = edited(rng, history[at])
            history = [*history[: at + 1], scene]
            at += 1
        shown.append(scene)
        done.append(name)
    return done, shown


def test_both_renderers_follow_random_edits_and_agree(start, gl_backend):
    camera = VIEW.for_size(SIZE)
    refused = 0
    with Rasterizer(start, backend=gl_backend) as rasterizer, Tracer(start) as tracer:
        for seed in range(SEQUENCES):
            done, shown = sequence(seed, start)
            refused += sum("refused" in name for name in done)
            for scene in shown[1:]:
                rasterizer.set_scene(scene)
                tracer.set_scene(scene)
            raster, ray = (r.render(camera, SIZE, CHANNELS) for r in (rasterizer, tracer))
            found = compare_frames(flatten(shown[-1]), camera, SIZE, raster, ray)
            assert not found.unexplained, (seed, done)
    assert refused < 0.3 * SEQUENCES * EDITS_EACH


def test_what_is_saved_after_random_edits_is_the_scene_in_its_authors_words(start):
    path = documents.file_of(start)
    for seed in range(24):
        newline = "\r\n" if seed % 2 else "\n"
        path.write_bytes(SCENE.replace("\n", newline).encode())
        loaded = load_scene(path)
        sections = sections_of(loaded)
        done, shown = sequence(seed, loaded)
        scene = shown[-1]
        saved = documents.save(scene)
        assert not documents.is_unsaved(saved) and not documents.is_unsaved(scene), done
        check_same(load_scene(path), scene)
        check_same(saved, scene)
        text = path.read_bytes().decode()
        assert "# A scene to edit: comments everywhere." + newline in text, done
        assert newline == "\n" or "\n" not in text.replace("\r\n", "")
        for entry in scene.origin.entries:
            if entry.key in sections and entry.table is sections[entry.key][0]:
                assert sections[entry.key][1].replace("\n", newline) in text, done


def sections_of(scene: Scene) -> dict[int, tuple[dict, str]]:
    """Return for each object of SCENE its table, and its section with its comments."""
    parts = SCENE.replace("\n\n[objects.material]", "[objects.material]").split("\n\n")
    texts = [part.strip("\n") for part in parts if "[[objects]]" in part]
    texts = [text.replace("[objects.material]", "\n\n[objects.material]") for text in texts]
    entries = scene.origin.entries
    assert all(text in SCENE for text in texts)
    return {e.key: (e.table, text + "\n") for e, text in zip(entries, texts, strict=True)}


def test_flat_arrays_that_follow_are_those_that_are_made_anew(start):
    kinds = set()
    for seed in range(SEQUENCES):
        done, shown = sequence(1000 + seed, start)
        kinds |= {name.split(" (")[0] for name in done}
        known = start, flatten(start)
        for scene in shown[1:]:
            followed, anew = flatten(scene, known), flatten(scene)
            for name, one, other in zip(anew._fields, followed, anew, strict=True):
                np.testing.assert_array_equal(one, other, err_msg=f"{name} after {done}")
            known = scene, followed
    assert set(EDITS) <= kinds


def test_a_copy_that_is_turned_back_has_its_own_normals_again(start):
    """The two share a mesh, and the other one was in that turn all the time."""
    torus = objects.new_table(start, "torus", [0, 0, 0], 1.0)
    scene, items = objects.add(start, torus)
    scene, copies = objects.duplicate(scene, items, (1, 0, 0))
    turned = changing.set_field(scene, copies, "rotate_deg", [0, 40, 0])
    back = changing.set_field(turned, copies, "rotate_deg", None)
    followed = flatten(back, (turned, flatten(turned, (scene, flatten(scene)))))
    np.testing.assert_array_equal(followed.normals, flatten(back).normals)
