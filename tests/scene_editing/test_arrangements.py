"""Random edits of one scene in random arrangements of its file, saved in between: no comment goes
whose object, light, material or field is still there, and no letter of what has not changed."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
from arrangements import TABLES, Path, arranged
from PIL import Image
from random_edits import edited

from renderer.scene import Scene, load_scene
from renderer.scene.tables import parse_toml
from renderer.scene_editing import documents

LISTS = ("objects", "lights")
Names = dict[str, str]  # of the file's materials: the present ones
NOTHING = object()


def names_after(before: Scene, after: Scene, names: Names) -> Names:
    """A renamed material has its table at the same place under another name."""
    old, new = (scene.origin.tables.get("materials", {}) for scene in (before, after))
    gone = {
        name: other
        for name, other in zip(old, new, strict=False)
        if name not in new and other not in old and old[name] == new[other]
    }
    there = {first: gone.get(name, name) for first, name in names.items()}
    return {first: name for first, name in there.items() if name in new}


def found(path: Path, scene: Scene, keys: dict[str, Any], names: Names) -> Any:
    """Return the scene's value at a path of its file, by that file's keys and names; else NOTHING."""
    place: list[Any] = list(path)
    try:
        if len(path) > 1 and path[0] in LISTS:
            key = keys[str(path[0])][path[1]]
            place[1] = scene.origin.keys[LISTS.index(str(path[0]))].index(key)
        elif len(path) > 1 and path[0] == "materials":
            place[1] = names[str(path[1])]
        value: Any = scene.origin.tables
        for part in place:
            value = value[part]
    except (LookupError, ValueError, TypeError):
        return NOTHING
    return value


def original(path: Path) -> Any:
    value: Any = TABLES
    for part in path:
        value = value[part]
    return value


def test_saving_keeps_comments_and_letters(tmp_path):
    Image.new("RGB", (2, 2), (200, 100, 50)).save(tmp_path / "texels.png")
    path = tmp_path / "scene.toml"
    for seed in range(100):
        rng = np.random.default_rng([20261124, seed])
        text, owners, pieces = arranged(rng)
        assert parse_toml(text) == TABLES and all(piece in text for piece, _ in pieces)
        path.write_bytes(text.encode())
        scene = load_scene(path)
        keys = dict(zip(LISTS, scene.origin.keys, strict=True))
        history, at = [(scene, {name: name for name in TABLES["materials"]})], 0
        done = [f"seed {seed}"]
        for number in range(6):
            if rng.random() < 0.2:
                at = int(rng.integers(len(history)))
                done.append(f"to {at}")
            else:
                name, scene = edited(rng, history[at][0])
                names = names_after(history[at][0], scene, history[at][1])
                history, at = [*history[: at + 1], (scene, names)], at + 1
                done.append(name)
            if number % 3 == 2:
                scene, names = history[at]
                documents.save(scene)
                new = path.read_bytes().decode()
                assert load_scene(path).origin.tables == scene.origin.tables, done
                there = {
                    p: found(p, scene, keys, names)
                    for p in {*owners.values(), *(p for _, p in pieces)}
                }
                # What was saved away does not come back by undo.
                owners = {c: p for c, p in owners.items() if there[p] is not NOTHING}
                assert [c for c in owners if new.count(c) != 1] == [], done
                pieces = [
                    (piece, p)
                    for piece, p in pieces
                    if there[p] is not NOTHING
                    and ("[[" in piece or there[p] == original(p))
                    and (p[0] != "materials" or all(names.get(k) == k for k in names))
                ]
                for piece, count in Counter(piece for piece, _ in pieces).items():
                    assert new.count(piece) >= count, (done, piece)
                assert "\r" not in text or "\n" not in new.replace("\r\n", ""), done
