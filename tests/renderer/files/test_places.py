"""In which line of a TOML file a field stands."""

import pytest

from lucida.renderer.files.places import Places, parsed_path


class TestPlaces:
    def test_every_form_of_toml(self):
        text = (
            "a = 1 # [x]\n"  # 1
            "'b c'.d = { e = [1, { f = 2 }], g = '}' }\n"  # 2
            "\n"
            "[t] # comment\n"  # 4
            'x."y".z = "# not a comment ] ["\n'  # 5
            "list = [\n  1, # one\n  [2,\n   3],\n]\n"  # 6 to 10
            'long = """\nfirst\n\\"""\nlast"""\n'  # 11 to 14
            "same = '''one\ntwo'''\n"  # 15, 16
            "[[t.many]]\nk = 1\n"  # 17
            "[[t.many]]\n"  # 19
            "[t.many.in]\nk = 2\n"  # 20
            "[[t.many.in.deep]]\n[[t.many.in.deep]]\nlast = 1979-05-27T07:32:00Z\n"  # 22, 23
        )
        places = Places(text)
        lines = {
            "a": 1, "b c": 2, "b c.d": 2, "b c.d.e[1].f": 2, "b c.d.g": 2, "t": 4, "t.x.y.z": 5,
            "t.list": 6, "t.list[0]": 6, "t.list[1][1]": 6, "t.long": 12,
            "t.same": 15, "t.many[0]": 17, "t.many[0].k": 18, "t.many[1]": 19, "t.many[1].in": 20,
            "t.many[1].in.k": 21, "t.many[1].in.deep[1]": 23, "t.many[1].in.deep[1].last": 24,
        }  # fmt: skip
        assert {field: places.line(field) for field in lines} == lines
        # What is not there is where it should be.
        assert places.line("t.many[1].in.missing") == 20
        assert places.line("nothing") == 1

    def test_a_path_is_read_as_names_and_numbers(self):
        assert parsed_path("steps[3].camera.w") == ("steps", 3, "camera", "w")
        assert parsed_path("") == ()

    @pytest.mark.parametrize(
        "text",
        ["a = [1", "[[", '"', "{", "a = {", "= = =", "'''", "a.b.c", "a = [}", "a = {]", "a = [{"],
    )
    def test_what_is_no_toml_ends_too(self, text):
        assert Places(text).line("a") >= 1
