"""The camera that looks, and when it follows the other one."""

from types import SimpleNamespace

import pytest
from imgui_bundle import ImVec2

from app.outside import looking
from app.outside.looking import NOTHING, STILL_S, Scopes
from app.outside.options import OutsideOptions

PLACE = ImVec2(0, 0), ImVec2(300, 200)


@pytest.fixture
def made(monkeypatch):
    """The scopes that were computed."""
    found = []

    def scope(host, *_):
        found.append(host.inner)
        return SimpleNamespace(of=host.inner)

    monkeypatch.setattr(looking, "scope_of", scope)
    monkeypatch.setattr(looking.theme, "px", lambda size: size)  # there is no window
    return found


def host(inner, own=None):
    options = OutsideOptions(camera=own)
    state = SimpleNamespace(scene="scene", step=None, of=lambda _: options)
    renderers = SimpleNamespace(camera=lambda _: inner, size=(40, 30))
    return SimpleNamespace(inner=inner, state=state, renderers=renderers)


def test_nothing_is_computed_twice(made):
    scopes = Scopes()
    for now_s in (1.0, 1.0, 1.1):
        scopes.of(host("one"), (300, 200), *PLACE, NOTHING, False, now_s)
    scopes.of(host("two"), (300, 200), *PLACE, NOTHING, False, 1.2)
    assert made == ["one", "two"]
    scopes.of(host("two"), (310, 200), *PLACE, NOTHING, True, 1.2)  # another size, at once
    assert made == ["one", "two", "two"]


def test_a_slow_view_follows_when_the_other_camera_rests(made):
    scopes = Scopes()
    scopes.of(host(0), (300, 200), *PLACE, NOTHING, True, 0.0)
    for step in range(1, 40):
        scope = scopes.of(host(step), (300, 200), *PLACE, NOTHING, True, step / 60)
        assert scopes.waits and scope.of == 0
    now_s = 39 / 60 + STILL_S
    assert scopes.of(host(39), (300, 200), *PLACE, NOTHING, True, now_s - 0.01).of == 0
    assert scopes.of(host(39), (300, 200), *PLACE, NOTHING, True, now_s + 0.01).of == 39
    assert not scopes.waits
    assert made == [0, 39]


def test_the_users_own_camera_and_a_quick_view_wait_for_nothing(made):
    scopes = Scopes()
    for step in range(4):
        scopes.of(host(step), (300, 200), *PLACE, NOTHING, False, step / 60)
        assert not scopes.waits
    for step in range(4, 8):
        scopes.of(host(step, own="mine"), (300, 200), *PLACE, NOTHING, True, step / 60)
        assert not scopes.waits
    assert made == list(range(8))
