"""A scene file's text with other tables in it, in all the ways that TOML can be written."""

from __future__ import annotations

import tomllib

import pytest

from renderer.scene.rewriting import rewritten
from renderer.scene.tables import parse_toml


def changed(text: str, change, drop=(), order=None) -> str:
    """The text after a change of its tables. drop: numbers of objects; order: of the others."""
    old, new = parse_toml(text), parse_toml(text)
    count, lights = len(old.get("objects", [])), len(old.get("lights", []))
    keys = tuple(range(count)), tuple(range(100, 100 + lights))
    left = [k for k in (order or range(count)) if k not in drop]
    change(new)
    extra = new.get("objects", [])[count:]
    new["objects"] = [new["objects"][k] for k in left] + extra
    now = (*left, *range(count, count + len(extra)))
    found = rewritten(text, old, keys, new, (now, keys[1]))
    assert parse_toml(found) == new
    return found


def nothing(tables):
    pass


ONE = """\
# top

objects = [
    { type = "sphere", radius = 1.0 }, # the first
    { type = "box", size = [1, 2, 3] },
]
"""


def test_inside_an_inline_list_values_change_where_they_are():
    text = changed(ONE, lambda t: t["objects"][1]["size"].__setitem__(1, 5.0))
    assert text == ONE.replace("[1, 2, 3]", "[1, 5.0, 3]")
    text = changed(ONE, lambda t: t["objects"][0].update(name="a", radius=2.0))
    assert text == ONE.replace("radius = 1.0 }", 'radius = 2.0, name = "a" }')
    text = changed(ONE, lambda t: t["objects"][0].pop("radius"))
    assert text == ONE.replace(", radius = 1.0", "")
    text = changed(ONE, lambda t: t["objects"][0].pop("type") and t["objects"][0].update(type="x"))
    assert "# the first" in text


def test_an_inline_list_that_grows_is_written_anew_and_the_rest_stays():
    text = changed(ONE, lambda t: t["objects"].append({"type": "cone"}))
    assert text.startswith("# top\n\nobjects = [") and '{ type = "cone" }' in text


DOTTED = """\
[materials]
a.diffuse = "#ffffff" # white
a.checker.size = 2

[[objects]] # one
type = "sphere"
material.diffuse = [1, 1, 1]
"""


def test_dotted_keys_and_tables_of_tables():
    text = changed(DOTTED, lambda t: t["materials"]["a"]["checker"].update(size=3))
    assert text == DOTTED.replace("size = 2", "size = 3")
    text = changed(DOTTED, lambda t: t["materials"]["a"].update(shininess=3.0))
    assert text == DOTTED.replace("size = 2\n", "size = 2\na.shininess = 3.0\n")
    text = changed(DOTTED, lambda t: t["objects"][0].update(material="a"))
    assert text == DOTTED.replace("material.diffuse = [1, 1, 1]\n", 'material = "a"\n')
    text = changed(DOTTED, lambda t: t["objects"][0]["material"].update(shininess=1.0))
    assert text.endswith("material.diffuse = [1, 1, 1]\nmaterial.shininess = 1.0\n")


BLOCKS = """\
lucida = 1

# first
[[objects]]
type = "sphere"
# radius: default

# --- between ---

# second
[[objects]]
type = "box"   # a box
[objects.material]
diffuse = [1, 0, 0]

# third
[[objects]]
type = "cone"
"""


def test_a_section_goes_with_its_comments_and_leaves_the_others():
    text = changed(BLOCKS, nothing, drop=(0,))
    assert "# first" not in text and "# radius: default" not in text
    assert "# --- between ---\n\n# second\n" in text
    text = changed(BLOCKS, nothing, drop=(1,))
    assert "# second" not in text and "# --- between ---\n\n# third\n" in text
    text = changed(BLOCKS, nothing, drop=(0, 1, 2))
    assert tomllib.loads(text)["objects"] == [] and "# --- between ---" in text


def test_a_section_moves_with_its_comments():
    text = changed(BLOCKS, nothing, order=[2, 0, 1])
    assert text.index("# third") < text.index("# first") < text.index("# second")
    for section in ('# third\n[[objects]]\ntype = "cone"\n', "# first\n[[objects]]\n"):
        assert section in text
    assert "[objects.material]\ndiffuse = [1, 0, 0]\n" in text


def test_what_is_new_comes_where_it_belongs():
    text = changed(BLOCKS, lambda t: t.update(camera={"eye": [0, 0, 1]}, ambient=[0, 0, 0]))
    assert text.startswith(
        "lucida = 1\nambient = [0, 0, 0]\n\n[camera]\neye = [0, 0, 1]\n\n# first"
    )
    text = changed(BLOCKS, lambda t: t.update(materials={"a b": {"diffuse": "#ffffff"}}))
    assert '\n\n[materials."a b"]\ndiffuse = "#ffffff"\n\n# first\n' in text
    text = changed('[[objects]]\ntype = "box"', lambda t: t["objects"].append({"type": "cone"}))
    assert text == '[[objects]]\ntype = "box"\n\n[[objects]]\ntype = "cone"\n'
    text = changed('[[objects]]\ntype = "box"', lambda t: t["objects"][0].update(size=2.0))
    assert text == '[[objects]]\ntype = "box"\nsize = 2.0\n'
    text = changed("# no more\nobjects = []\n", lambda t: t["objects"].append({"type": "box"}))
    assert text.startswith("# no more\n") and text.endswith('[[objects]]\ntype = "box"\n')


ODD = """\
[[objects]]
type = "box"

[materials.a]
diffuse = "#ffffff"

[objects.material]
diffuse = [1, 0, 0]
"""


@pytest.mark.parametrize(
    "text", [ODD, "name = '''\nx = 1 # no \"comment\"\n'''\n[[objects]]\ntype = \"box\"\n"]
)
def test_however_it_is_arranged_what_comes_out_is_what_should(text):
    for change in (
        lambda t: t["objects"].append({"type": "cone"}),
        lambda t: t["objects"][0].update(size=3),
        lambda t: t.update(name="other"),
    ):
        changed(text, change)
    changed(text, nothing, drop=(0,))
