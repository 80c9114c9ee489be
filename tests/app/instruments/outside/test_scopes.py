"""The outside camera, and when it follows the scene's camera."""

import math
from dataclasses import replace
from types import SimpleNamespace

import pytest
from imgui_bundle import ImVec2

from lucida.app.images.ray_pictures import RayPictures
from lucida.app.instruments.outside import looking
from lucida.app.instruments.outside.looking import NOTHING, STILL_S, Scopes, ray_ends
from lucida.app.instruments.outside.mouse import Area
from lucida.app.state.options.outside import OutsideOptions
from lucida.renderer.camera.camera import Camera

PLACE = Area((300, 200), ImVec2(0, 0), ImVec2(300, 200))
REACH = 3  # cameras are numbers here; a picture shows those that are nearer to it


@pytest.fixture
def made(monkeypatch):
    """Collect the cameras whose scopes are computed."""
    found = []

    def scope(host, *_):
        found.append(host.inner)
        return SimpleNamespace(of=host.inner, shown=host.inner)

    monkeypatch.setattr(looking, "scope_of", scope)
    monkeypatch.setattr(looking, "is_in_picture", is_near)
    monkeypatch.setattr(looking.theme, "px", lambda size: size)  # there is no window
    return found


def is_near(camera, shown, arrow):
    return isinstance(camera, int) and abs(camera - shown) < REACH


def host(inner, own=None):
    options = OutsideOptions(camera=own)
    state = SimpleNamespace(scene="scene", step=None, options=SimpleNamespace(outside=options))
    renderers = SimpleNamespace(camera=lambda _: inner, size=(40, 30))
    focus = SimpleNamespace(reach=1.0)
    return SimpleNamespace(inner=inner, state=state, renderers=renderers, focus=focus)


def test_a_scope_is_computed_once(made):
    scopes = Scopes()
    for now_s in (1.0, 1.0, 1.1):
        scopes.of(host("one"), PLACE, NOTHING, now_s)
    scopes.of(host("two"), PLACE, NOTHING, 1.2)
    assert made == ["one", "two"]
    scopes.of(host("two"), PLACE._replace(size=(310, 200)), NOTHING, 1.2)  # another size, at once
    assert made == ["one", "two", "two"]


def test_the_view_stays_while_the_moving_camera_is_in_sight(made):
    scopes = Scopes()
    for step in range(8):
        scope = scopes.of(host(step), PLACE, NOTHING, step / 60)
        assert scope.of == step // REACH * REACH
    assert scopes.moves
    for now_s in (7 / 60, 7 / 60 + STILL_S + 0.01):  # the button is held: a pause ends no drag
        scope = scopes.of(host(7), PLACE, NOTHING, now_s, True)
        assert scope.of == 6
    scope = scopes.of(host(7), PLACE, NOTHING, 7 / 60 + STILL_S + 0.01)
    assert scope.of == 7 and not scopes.moves
    assert made == [0, 3, 6, 7]


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_camera_is_in_the_picture_with_its_basis_and_its_image_plane(projection):
    watching = Camera.look_at((0.0, 0.0, 20.0), (0.0, 0.0, 0.0), fov_y_deg=50.0, aspect=1.5)
    half = 20 * math.tan(math.radians(25))
    if projection == "parallel":
        view = (-1.5 * half, 1.5 * half, -half, half)
        watching = replace(watching, projection=projection, viewport=view)
    for eye, is_visible in [
        ((0.0, 0.0, 0.0), True),
        ((0.0, half - 2.0, 0.0), True),
        ((0.0, half - 0.1, 0.0), False),  # the eye is, its image plane is not
        ((1.5 * half + 1.0, 0.0, 0.0), False),
    ]:
        assert looking.is_in_picture(replace(Camera.canonical(), eye=eye), watching) == is_visible
    if projection == "perspective":
        behind = replace(Camera.canonical(), eye=(0.0, 0.0, 30.0))
        assert not looking.is_in_picture(behind, watching)


def test_the_users_own_camera_moves_at_once(made):
    scopes = Scopes()
    for step in range(4):
        scopes.of(host(step, own="mine"), PLACE, NOTHING, step / 60)
    assert made == list(range(4))


def test_an_unmarked_pixels_ray_is_not_awaited():
    hits = RayPictures("test", lambda: None)
    live = SimpleNamespace(tracer_of=lambda _: None, preparing_s=1.0)  # the ray has to wait
    renderers = SimpleNamespace(live=live, size=(40, 30), depth_at=lambda *_: None)
    state = SimpleNamespace(
        scene="scene", marked=(3, 4), options=SimpleNamespace(outside=OutsideOptions())
    )
    window = SimpleNamespace(state=state, renderers=renderers, hovered=None)
    about = hits, window, Camera(), (40, 30)
    assert ray_ends(*about, ())[0].pixel == (3, 4)
    assert hits.busy
    state.marked = None
    assert ray_ends(*about, ())[0] is None
    assert not hits.busy
    hits.close()
