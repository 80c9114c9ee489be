"""A scene file's text with other tables in it, in all the ways that TOML can be written."""

from __future__ import annotations

import pytest

from lucida.renderer.files.rewriting import rewritten
from lucida.renderer.files.tables import parse_toml


def attempt(text, change, drop=(), order=None):
    """The text after a change of its tables, and these. drop: numbers of objects; order: of the
    others."""
    old, new = parse_toml(text), parse_toml(text)
    count, lights = len(old.get("objects", [])), len(old.get("lights", []))
    keys = tuple(range(count)), tuple(range(100, 100 + lights))
    left = [k for k in (order or range(count)) if k not in drop]
    change(new)
    extra = new.get("objects", [])[count:]
    new["objects"] = [new["objects"][k] for k in left] + extra
    now = (*left, *range(count, count + len(extra)))
    return rewritten(text, old, keys, new, (now, keys[1])), new


def changed(text, change, drop=()):
    found, new = attempt(text, change, drop)
    assert found is not None and parse_toml(found) == new
    return found


def nothing(tables):
    pass


LINED = """\
objects = [ # all of them
    { type = "sphere", radius = 1.0 }, # the first
    { type = "box" },
]
"""


def test_a_list_in_brackets_stays_or_is_refused():
    text = changed(LINED, lambda t: t.update(name="a"))
    assert text == LINED + 'name = "a"\n'
    text = changed(LINED, lambda t: t["objects"][0].update(radius=2.0))
    assert text == LINED.replace("1.0", "2.0")
    assert attempt(LINED, lambda t: t["objects"].append({"type": "cone"}))[0] is None


BLOCKS = """\
lucida = 1
a.b = 1 # dotted

# first
[[objects]]
type = "sphere"
# radius: default

# --- between ---

# second
[[objects]]
type = "box"   # a box
checker = { size = 1 } # cells
[objects.material] # its own
diffuse = [1, 0, 0]

# third
[[objects]]
type = "cone"
points = [
  [1],
[2]
]

# a lamp
[[lights]]
type = "point"
"""


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        (lambda t: t["objects"][1].update(type="disk"), ('"box" ', '"disk" ')),
        (lambda t: t["objects"][1]["checker"].update(size=2.5), ("size = 1", "size = 2.5")),
        (lambda t: t["objects"][1].pop("checker"), ("checker = { size = 1 } # cells\n", "")),
        (
            lambda t: t["objects"][0].update(radius=2.0),
            ("# radius: default\n", "# radius: default\nradius = 2.0\n"),
        ),
        (
            lambda t: t["objects"][1]["material"].update(checker={"size": 2}),
            ("[1, 0, 0]\n", "[1, 0, 0]\nchecker = { size = 2 }\n"),
        ),
        (
            lambda t: t["objects"][1].update(material="red"),
            (
                "# cells\n[objects.material] # its own\ndiffuse = [1, 0, 0]\n",
                '# cells\nmaterial = "red"',
            ),
        ),
        (
            lambda t: t["objects"][2]["points"].__setitem__(1, [3]),
            ("points = [\n  [1],\n[2]\n]\n", "points = [[1], [3]]\n"),
        ),
        (lambda t: t["a"].update(b=2), ("a.b = 1", "a.b = 2")),
        (lambda t: t.update(ambient=[0, 0, 1]), ("otted\n", "otted\nambient = [0, 0, 1]\n")),
        (
            lambda t: t.update(camera={"eye": [0, 0, 1]}),
            ('type = "point"\n', 'type = "point"\n\n[camera]\neye = [0, 0, 1]\n'),
        ),
        (
            lambda t: t["objects"].append({"type": "torus"}),
            ("# a lamp", '[[objects]]\ntype = "torus"\n\n# a lamp'),
        ),
    ],
)
def test_what_has_not_changed_stays_to_the_letter(change, wanted):
    assert changed(BLOCKS, change) == BLOCKS.replace(*wanted)


def test_an_object_goes_with_the_comments_directly_above_it():
    text = changed(BLOCKS, nothing, drop=(0,))
    assert "# first" not in text and "# second\n" in text
    text = changed(BLOCKS, nothing, drop=(1,))
    assert "# second" not in text and "# its own" not in text and "# third" in text
    text = changed(BLOCKS, nothing, drop=(0, 1, 2))
    assert parse_toml(text)["objects"] == [] and "# a lamp" in text


def test_what_is_new_comes_where_it_belongs():
    text = changed('[[objects]]\ntype = "box"', lambda t: t["objects"].append({"type": "cone"}))
    assert text == '[[objects]]\ntype = "box"\n\n[[objects]]\ntype = "cone"\n'
    text = changed('[[objects]]\ntype = "box"', lambda t: t["objects"][0].update(size=2.0))
    assert text == '[[objects]]\ntype = "box"\nsize = 2.0\n'
    text = changed("# none\nobjects = []\n", lambda t: t["objects"].append({"type": "box"}))
    assert text == '# none\n[[objects]]\ntype = "box"\n'
    text = changed("# top\n\n[[objects]]\n", lambda t: t.update(name="x"))
    assert text == '# top\nname = "x"\n\n[[objects]]\n'


def test_what_was_deleted_and_saved_comes_back_where_it_was():
    tables = parse_toml(BLOCKS)
    less = {**tables, "objects": [tables["objects"][k] for k in (0, 2)]}
    text = changed(BLOCKS, nothing, drop=(1,))
    again = rewritten(text, less, ((0, 2), (100,)), tables, ((0, 1, 2), (100,)))
    assert again is not None and parse_toml(again) == tables and "# third" in again


@pytest.mark.parametrize(
    "text",
    [
        "[materials]\na.diffuse = 1 # white\n[[objects]] # one\nmaterial.diffuse = [1, 1, 1]\n",
        "name = '''\nx = 1 # no \"comment\"\n[[objects]]\n'''\n[[objects]]\ntype = \"box\"\n",
        '# top\n[materials."caf\\u00e9 \\"x\\""] # a\ndiffuse = 1 # b\n[[objects]]\n',
        "[[objects]]\r\ntype = 1 # one\r\n\r\n[objects.material]\r\nx = 1\r\n",
        "[[objects]] # a\n[[lights]] # l\n[objects.material] # m\nx = 1\n[[objects]] # b\n",
    ],
)
def test_however_it_is_arranged_what_comes_out_is_what_should(text):
    for change in (
        lambda t: t["objects"].append({"type": "cone"}),
        lambda t: t["objects"][0].update(size=3),
        lambda t: t.update(ambient=[0, 0, 1]),
    ):
        found = changed(text, change)
        assert found.count("#") == text.count("#")
        assert "\r" not in text or "\n" not in found.replace("\r\n", "")
    changed(text, nothing, drop=(0,))


def test_another_order_is_refused():
    assert attempt(BLOCKS, nothing, order=[2, 0, 1])[0] is None
