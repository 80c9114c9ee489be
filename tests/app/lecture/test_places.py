"""In which line of a TOML file a field stands."""

from __future__ import annotations

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
            "t.list": 6, "t.list[0]": 7, "t.list[1]": 8, "t.list[1][1]": 9, "t.long": 12,
            "t.same": 15, "t.many[0]": 17, "t.many[0].k": 18, "t.many[1]": 19, "t.many[1].in": 20,
            "t.many[1].in.k": 21, "t.many[1].in.deep[1]": 23, "t.many[1].in.deep[1].last": 24,
        }  # fmt: skip
        assert {field: places.line(field) for field in lines} == lines
        # What is not there is where it should be.
        assert places.line("t.many[1].in.missing") == 20
        assert places.line("nothing") == 1

    def test_nothing_between_signs(self):
        """Or all that may be: spaces about names, commas after the last, comments."""
        text = (
            "[t]#k = 9\n"  # 1
            "t=1\n"
            "k=[[1]]\n"  # 3
            "m=[1,2,\n3]\n"  # 4, 5
            "n={}\n"
            'o="""\n\nx"""\n'  # 7 to 9
            "p={a={},b={c=1}}\n"
            "r=[{a=1},\n{b=[\n1]},\n{}]\n"  # 11 to 14
            "[[u.v]]#k = 9\n"
            "k=1\n"  # 16
            "[ v . w ] #\n"
            " x . y\t= [ # ]\n 1 , # ,\n 2 , ]\n"  # 18 to 20
            "z = 1\n"
        )
        places = Places(text)
        lines = {
            "t": 1, "t.t": 2, "t.k": 3, "t.k[0][0]": 3, "t.m[1]": 4, "t.m[2]": 5, "t.n": 6,
            "t.o": 8, "t.p.b.c": 10, "t.r[0].a": 11, "t.r[1]": 12, "t.r[1].b": 12,
            "t.r[1].b[0]": 13, "t.r[2]": 14, "u.v[0]": 15, "u.v[0].k": 16,
            "v.w": 17, "v.w.x": 18, "v.w.x.y": 18, "v.w.x.y[0]": 19, "v.w.x.y[1]": 20, "v.w.z": 21,
        }  # fmt: skip
        assert {field: places.line(field) for field in lines} == lines
        # A table and an array of tables begin where the first of them does.
        assert places.line("u") == places.line("u.v") == 15

    def test_paths(self):
        assert parsed_path("steps[3].camera.w") == ("steps", 3, "camera", "w")
        assert parsed_path("") == ()

    @pytest.mark.parametrize(
        "text",
        ["a = [1", "[[", '"', "{", "a = {", "= = =", "'''", "a.b.c", "a = [}", "a = {]", "a = [{"],
    )
    def test_what_is_no_toml_ends_too(self, text):
        assert Places(text).line("a") >= 1
