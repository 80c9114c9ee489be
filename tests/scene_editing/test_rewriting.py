"""A scene file's text with other tables in it, in all the ways that TOML can be written."""

from __future__ import annotations

import re
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


def test_comments_at_the_end_of_an_inline_list_that_becomes_empty_stay():
    text = ONE.replace("3] },\n", "3] },\n    # to come: a cone\n")
    assert "\n    # to come: a cone\n]" in changed(text, nothing, drop=(0, 1))


CROWDED = """\
[materials.a]
# of a
diffuse = "#ffffff"
[materials.b]
shininess = 2.0

[[objects]]
type = "sphere"
material = "a"
# last

[[objects]]
type = "box"
[[objects]]
type = "cone"

# inside, apart

[objects.material]
shininess = 3.0
"""


def test_comments_stay_with_their_section_where_what_was_between_goes():
    text = changed(CROWDED, lambda t: t["materials"].update(a={}))
    assert "# of a" in changed(text, lambda t: t["materials"].pop("b"))
    text = changed(CROWDED, nothing, drop=(1,))
    assert "# last" in changed(text, nothing, drop=(1,))
    text = changed(CROWDED, nothing, order=(2, 0, 1))
    assert text.count("# inside, apart") == 1
    assert changed(text, lambda t: t["objects"][0].update(material="a")).count("# inside") == 1


def test_the_last_material_takes_its_table_along_and_no_comments():
    for text in ("[materials.a] # a\n", "materials = { a = {} } # ours\n", "materials.a = {}\n"):
        found = changed(f"# top\n\nobjects = []\n{text}", lambda t: t.pop("materials"))
        assert "materials" not in found and ("# ours" in found) == ("# ours" in text)


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


LINED = """\
objects = [ # all of them
    # a ball
    { type = "sphere", radius = 1.0 }, # the first
    { type = "box", size = [1, # over lines
      2, 3] },  # the second

    # a cone
    { type = "cone" } # the last
] # the end
"""


def test_a_list_in_brackets_keeps_its_comments_whatever_comes_and_goes():
    text = changed(LINED, lambda t: t["objects"].append({"type": "torus"}))
    assert text == LINED.replace("} # the last\n", '}, # the last\n    { type = "torus" }\n')
    text = changed(LINED, nothing, drop=(1,))
    kept = LINED.splitlines(keepends=True)
    assert text == "".join(kept[:3] + kept[5:])
    text = changed(LINED, nothing, order=[2, 0, 1])
    assert text.startswith("objects = [ # all of them\n\n    # a cone\n")
    assert text.endswith("      2, 3] }  # the second\n] # the end\n")
    text = changed(LINED, lambda t: t["objects"][1].update(size=2.0), drop=(0, 2))
    box = '    { type = "box", size = 2.0 }  # the second\n'
    assert text == "# over lines\nobjects = [ # all of them\n" + box + "] # the end\n"


@pytest.mark.parametrize(
    ("order", "text", "wanted"),
    [
        ("BA", "[A,B,]", "[B,A,]"),
        ("BA", "[ A, B ]", "[ B, A ]"),
        ("BA", "[A, # 1\r\n B] # 2\r\n", "[\r\n B,\r\n A # 1\r\n] # 2\r\n"),
        ("BA", "[A\n,B]", "[\nB,\nA]"),
        ("BA", "[A,\n# 2\nB]", "[\n# 2\nB, A]"),
        ("BAC", "[A, B, # 2\n C]", "[B, # 2\nA,\n C]"),
        ("BA", "[ # all\n # 1\n A,B]", "[ # all\nB,\n # 1\n A]"),
    ],
)
def test_lists_in_brackets_in_other_arrangements(order, text, wanted):
    text, wanted = (
        "objects = " + re.sub("[ABC]", "{type = '\\g<0>'}", part) for part in (text, wanted)
    )
    assert changed(text, nothing, order=["ABC".index(one) for one in order]) == wanted


def test_keys_with_escapes_are_found():
    text = '# top\n[materials."caf\\u00e9 \\"x\\""] # a\ndiffuse = 1 # b\n[[objects]]\n'
    found = changed(text, lambda t: t["materials"]['café "x"'].update(diffuse=2))
    assert found.startswith(text.replace("= 1", "= 2"))


APART = """\
[[objects]] # a
type = "sphere"

[[lights]] # l
type = "point"

[objects.material] # m
diffuse = [1, 0, 0]

[[objects]] # b
type = "box"
"""


def test_a_section_between_those_of_an_object_stays():
    text = changed(APART, lambda t: t["objects"][0].update(type="cone"))
    assert text == APART.replace("sphere", "cone")
    text = changed(APART, lambda t: t["objects"].append({"type": "torus"}))
    assert text == APART + '\n[[objects]]\ntype = "torus"\n'
    for order in ([1, 0], [1]):
        text = changed(APART, nothing, order=order, drop={0, 1} - set(order))
        assert "# l" in text and "# b" in text and ("# m" in text) == (0 in order)


RENAMED = """\
# of the file
[materials.red] # shiny
diffuse = [1, 0, 0] # light
[materials.red.checker] # cells
size = 2

[materials]
"a b".diffuse = [0, 0, 1] # blue
c = { diffuse = [0, 1, 0] } # green

[[objects]]
type = "box"
material = "red" # here
"""


@pytest.mark.parametrize("name", ["red", "a b", "c"])
def test_a_material_of_another_name_keeps_its_comments(name):
    def rename(tables):
        materials = tables["materials"]
        tables["materials"] = {
            "new name" if key == name else key: table for key, table in materials.items()
        }
        if name == "red":
            tables["objects"][0]["material"] = "new name"

    found = changed(RENAMED, rename)
    assert found.count("#") == RENAMED.count("#") and '"new name"' in found


TWO = """\
[materials.a] # a
diffuse = 1
shininess = 2
[materials.b] # b
diffuse = 1
shininess = 3
[[objects]]
material = "b"
"""


def test_the_most_alike_material_or_the_one_in_its_use_is_the_renamed_one():
    found = changed(
        TWO, lambda t: t["materials"].update(x=t["materials"].pop("b"), y=t["materials"].pop("a"))
    )
    assert "[materials.y] # a" in found and "[materials.x] # b" in found

    def replaced(tables):
        del tables["materials"]["b"]
        tables["materials"]["z"] = {"specular": 4}
        tables["objects"][0]["material"] = "z"

    assert "[materials.z] # b" in changed(TWO, replaced)


INLINE = """\
materials = { m = { diffuse = "#ff0000" }, "n" = { texture.file = "a.png" } } # shared
[[objects]] # a
type = "box"
material = { texture = "a.png" } # own
[[objects]] # b
type = "sphere"
[objects.material] # table
diffuse = "#00ff00" # green
[objects.material.checker] # cells
size = 2 # large
"""


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        (
            lambda t: t["objects"][0].update(material={"diffuse": 1}),
            ('{ texture = "a.png" }', "{ diffuse = 1 }"),
        ),
        (lambda t: t["objects"][0]["material"].clear(), ('{ texture = "a.png" }', "{}")),
        (
            lambda t: t["materials"].update(x=t["materials"].pop("m")),
            ("{ m = {", "{ x = {"),
        ),
        (
            lambda t: t["materials"].pop("m"),
            ('{ m = { diffuse = "#ff0000" }, "n"', '{ "n"'),
        ),
        (
            lambda t: t["materials"]["n"].update(shininess=3),
            ('"a.png" } } #', '"a.png", shininess = 3 } } #'),
        ),
        (
            lambda t: t["objects"][1]["material"].pop("checker"),
            ("[objects.material.checker] # cells\nsize = 2 # large\n", ""),
        ),
        (
            lambda t: t["objects"][1].update(material="m"),
            (
                INLINE[INLINE.index("[objects.material] #") :],
                'material = "m"\n# table\n',
            ),
        ),
    ],
)
def test_tables_in_brackets_and_tables_in_tables(change, wanted):
    assert changed(INLINE, change) == INLINE.replace(*wanted)


def test_tables_in_tables_move_with_their_object():
    text = changed(INLINE, lambda t: t["objects"][1]["material"].update(shininess=3), order=[1, 0])
    assert text.count("#") == INLINE.count("#") and "green\nshininess = 3\n" in text
    only_inner = INLINE.replace('[objects.material] # table\ndiffuse = "#00ff00" # green\n', "")
    text = changed(only_inner, lambda t: t["objects"][1]["material"].update(shininess=3))
    assert "[objects.material]\nshininess = 3\n\n[objects.material.checker] # cells\n" in text
