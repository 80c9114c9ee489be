"""The loop stepper: two algorithms, one image, the fast renderers'; and every step of it."""

from __future__ import annotations

import inspect
import math
import sys
from dataclasses import replace
from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest

from app.explaining.projected import EVERYTHING, NOTHING, mesh_extent, sphere_extent
from app.stepper import loops, recording
from app.stepper import model as stepper
from app.stepper.loop_parts import MISS, Hit, Model, ViewingRay, _meets_box, bounding_box
from app.stepper.loops import image_order, object_order
from app.stepper.model import Moment, moment_at
from app.stepper.raster_parts import Corner, triangles
from app.stepper.recording import Order, Recording
from renderer.camera import Camera
from renderer.compare import compare_frames
from renderer.errors import LucidaError
from renderer.frame import CHANNELS
from renderer.scene import BUILTIN_SCENES, load_scene, shapes
from renderer.scene.model import Material, PointLight, Scene, SceneObject, Sphere
from renderer.trace import Tracer

SIZE = (20, 15)
TWO_BALLS = Scene(
    (
        SceneObject(Sphere((0, 0, -5), 2), Material((0.9, 0.1, 0.1)), "far"),
        SceneObject(Sphere((0.3, 0, -3), 0.5), Material((0.1, 0.9, 0.1)), "near"),
    ),
    (PointLight((2, 3, 1)),),
    background=(0.25, 0.5, 0.75),
)
TWO_BOXES = Scene(
    tuple(
        SceneObject(shapes.translate(shapes.box((size, size, size)), place), color, name)
        for name, size, place, color in (
            ("far", 4.0, (0.0, 0.0, -7.0), Material((0.9, 0.1, 0.1))),
            ("near", 1.0, (0.3, 0.0, -3.0), Material((0.1, 0.9, 0.1))),
        )
    ),
    (PointLight((2, 3, 1)),),
    background=(0.25, 0.5, 0.75),
)
SCENES = {Order.RASTER: TWO_BOXES, Order.OBJECT: TWO_BALLS, Order.IMAGE: TWO_BALLS}


def recorded(scene: Scene, order: Order, camera: Camera | None = None, size=SIZE) -> Recording:
    run = Recording(Model(scene), camera or Camera.canonical(), size, order)
    run.run()
    assert run.complete and not run.truncated
    return run


def last(run: Recording) -> Moment:
    return moment_at(run, len(run) - 1)


# One image, proved against the fast renderers.


def cameras(scene: Scene, rng: np.random.Generator):
    """The scene's own view; then random ones: perspective, parallel, skewed, clipped."""
    own = scene.view.for_size(SIZE)
    yield own
    for kind in ("perspective", "parallel", "skewed", "clipped"):
        turn = np.eye(3) + rng.normal(scale=0.08, size=(3, 3))
        basis = own.basis @ (turn if kind == "skewed" else np.linalg.qr(turn)[0])
        if kind != "skewed":
            basis *= np.sign(np.sum(basis * own.basis, axis=0))
        eye = np.array(own.eye) + rng.normal(scale=0.3, size=3)
        depth = float(np.linalg.norm(eye)) + 3
        parallel = kind == "parallel"
        viewport = tuple(3.0 * side for side in own.viewport) if parallel else own.viewport
        yield Camera(
            tuple(eye),
            *(tuple(vector) for vector in basis.T),
            own.distance,
            viewport,
            "parallel" if parallel else "perspective",
            *((0.6 * depth, 0.9 * depth) if kind == "clipped" else (None, None)),
        )


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_both_orders_end_in_the_fast_renderers_image(name: str, rasterizer) -> None:
    scene = load_scene(name)
    model, rng = Model(scene), np.random.default_rng(7)
    rasterizer.set_scene(scene)
    seen = 0
    with Tracer(scene) as tracer, Tracer(scene, method="reference") as reference:
        for camera in cameras(scene, rng):
            by_object, by_image = (run(model, camera, SIZE) for run in (object_order, image_order))
            assert np.array_equal(by_object.array, by_image.array)
            exact = reference.render(camera, SIZE, channels=CHANNELS)
            np.testing.assert_allclose(by_image.array, exact.color, rtol=1e-6, atol=1e-7)
            # The loops' colours with the other channels of the same rays: agreement is 2/255, or
            # a line of the image within 1/128 pixel.
            ours = replace(exact, color=by_image.array.astype(np.float32))
            for fast in (rasterizer, tracer):
                frame = fast.render(camera, SIZE, channels=CHANNELS)
                result = compare_frames(model.flat, camera, SIZE, frame, ours)
                assert result.unexplained == 0, result.summary()
                assert result.agree > 0.95 * result.pixels, result.summary()
                assert result.max_color_error <= 2 / 255
            seen += int((exact.id >= 0).sum())
    assert seen > 300


# The code on the screen is the code that runs.


@pytest.mark.parametrize("order", Order)
def test_the_shown_source_is_what_runs(order: Order) -> None:
    run = recorded(SCENES[order], order)
    whole = inspect.getsource(order.renderer)
    docstring = f'    """{inspect.getdoc(order.renderer)}"""\n'
    assert "\n".join(run.source.lines) + "\n" == whole.replace(docstring, "")
    # As Python sees it: the shown text itself, executed, ends in the recorded image.
    names = dict(vars(loops))
    exec("from __future__ import annotations\n" + "\n".join(run.source.lines), names)
    canvas = names[order.renderer.__name__](run.model, run.camera, SIZE)
    assert np.array_equal(canvas.array, last(run).canvas)


@pytest.mark.parametrize("order", Order)
def test_lines_are_run_in_the_loops_order(order: Order) -> None:
    run = recorded(SCENES[order], order, size=(4, 3))
    source = run.source
    lines = [moment_at(run, step).line for step in range(len(run))]
    assert lines[0] == 1 and source.lines[lines[-1]] == "    return canvas"
    assert set(lines) == set(range(1, len(source.lines)))
    tested = "ec = edge(a, b, p)" if order is Order.RASTER else "intersect(object, ray)"
    assert tested in source.lines[source.test]
    assert source.lines[source.write].lstrip().startswith("canvas[i, j] = ")
    outer, inner = source.pixels, source.objects
    if order.has_depth:
        outer, inner = inner, outer
    assert source.lines[outer.header].startswith("    ") and outer.runs(inner.header)
    assert not inner.runs(outer.header)


# Steps.


def test_image_order_tests_each_object_at_each_pixel_and_writes_each_pixel_once() -> None:
    scene = load_scene("primitives")
    camera = scene.view.for_size(SIZE)
    run = recorded(scene, Order.IMAGE, camera)
    counters = last(run).counters
    assert counters.tests == 20 * 15 * len(scene.objects)
    assert (counters.writes, counters.overwrites) == (20 * 15, 0)


def test_object_order_tests_the_boxes_and_overwrites_what_was_in_front() -> None:
    """The far ball comes first: the near one is drawn over it."""
    run = recorded(TWO_BALLS, Order.OBJECT)
    boxes = [bounding_box(one, run.camera, SIZE) for one in run.model.objects]
    counters = last(run).counters
    assert counters.tests == sum(len(rows) * len(columns) for rows, columns in boxes)
    with Tracer(TWO_BALLS) as tracer:
        seen = tracer.render(Camera.canonical(), SIZE).id
    assert counters.writes - counters.overwrites == (seen >= 0).sum()
    assert counters.overwrites == (seen == 1).sum() > 0
    # The other way round, nothing is drawn twice.
    other = recorded(Scene(TWO_BALLS.objects[::-1], TWO_BALLS.lights), Order.OBJECT)
    assert last(other).counters.overwrites == 0


@pytest.mark.parametrize("order", Order)
def test_of_two_things_in_one_place_the_first_is_seen(order: Order) -> None:
    for place in (TWO_BALLS.objects[0].shape, TWO_BOXES.objects[0].shape):
        colors = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
        objects = tuple(SceneObject(place, Material(color)) for color in colors)
        run = recorded(Scene(objects, TWO_BALLS.lights), order, size=(6, 5))
        red, green, _ = last(run).canvas.reshape(-1, 3).T
        assert red.any() and not green.any()


@pytest.mark.parametrize("order", Order)
def test_every_moment_follows_from_the_one_before(order: Order) -> None:
    """The canvas, the depth buffer and the counters change by what the line before says."""
    run = recorded(SCENES[order], order, size=(6, 5))
    before = moment_at(run, 0)
    assert before.counters == stepper.Counters(0, 0, 0)
    written: set[tuple[int, int]] = set()
    for step in range(1, len(run)):
        now = moment_at(run, step)
        assert now.step == step
        tests = now.counters.tests - before.counters.tests
        assert tests == (before.line == run.source.test)
        wrote = before.line == run.source.write
        assert now.counters.writes - before.counters.writes == wrote
        assert (now.written is not None) == wrote
        if wrote:
            assert now.written == before.pixel
            assert before.pixel is not None
            expected = before.canvas.copy()
            expected[before.pixel] = now.canvas[before.pixel]
            assert np.array_equal(now.canvas, expected, equal_nan=True)
            assert np.isfinite(now.canvas[before.pixel]).all()
            again = now.counters.overwrites - before.counters.overwrites
            assert again == (before.pixel in written)
            written.add(before.pixel)
        elif before.line > 4:
            assert np.array_equal(now.canvas, before.canvas, equal_nan=True)
        if now.depth is not None and before.depth is not None:
            deeper = now.depth != before.depth
            assert deeper.sum() == run.source.lines[before.line].lstrip().startswith("depth[i, j]")
            assert (now.depth <= before.depth).all()
        before = now
    assert before.finished
    assert not moment_at(run, len(run) - 2).finished


def test_what_is_not_yet_set_shows() -> None:
    """Image order has no background until the ray has been found to hit nothing."""
    by_image, by_object = (recorded(TWO_BALLS, order) for order in (Order.IMAGE, Order.OBJECT))
    halfway = moment_at(by_image, len(by_image) // 2)
    unset = np.isnan(halfway.canvas).all(axis=2).ravel()
    assert np.array_equal(unset, np.arange(300) >= halfway.counters.writes)
    assert halfway.depth is None
    cleared = moment_at(by_object, by_object.object_steps[0])
    assert (cleared.canvas == (0.25, 0.5, 0.75)).all()
    assert cleared.depth is not None and (cleared.depth == math.inf).all()


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("order", [Order.OBJECT, Order.IMAGE])
def test_variables_are_the_lectures(order: Order, projection: str) -> None:
    """u = (j - 0.5) / W - 0.5, v = -((i - 0.5) / H - 0.5) with 1-based i, j; the ray from them."""
    camera = Camera(projection=projection)
    run = recorded(TWO_BALLS, order, camera)
    checked = 0
    for step in range(0, len(run), 7):
        now = moment_at(run, step)
        if now.ray is None:
            continue
        assert now.pixel is not None
        i, j = now.pixel[0] + 1, now.pixel[1] + 1
        u, v = (j - 0.5) / 20 - 0.5, -((i - 0.5) / 15 - 0.5)
        texts = {variable.name: variable.text for variable in now.variables}
        assert (texts["i"], texts["j"]) == (str(i - 1), str(j - 1))
        assert float(texts["u"]) == pytest.approx(u, abs=6e-5)
        assert float(texts["v"]) == pytest.approx(v, abs=6e-5)
        if projection == "parallel":
            assert now.ray.origin == pytest.approx((u, v, 0))
            assert now.ray.direction == pytest.approx((0, 0, -1))
        else:
            assert now.ray.origin == (0, 0, 0)
            assert now.ray.direction == pytest.approx((u, v, -1))
        checked += 1
    assert checked > 30


def test_what_has_just_changed_is_marked() -> None:
    run = recorded(TWO_BALLS, Order.IMAGE, size=(4, 3))
    first = int(run.pixel_steps[0])
    assert moment_at(run, first).ray is None
    changed = [
        {variable.name for variable in moment_at(run, first + k).variables if variable.changed}
        for k in range(1, 4)
    ]
    assert changed == [{"u"}, {"v"}, {"ray"}]
    assert moment_at(run, first + 3).ray is not None


def test_the_tests_of_a_pixel_and_of_an_object() -> None:
    by_image = recorded(TWO_BALLS, Order.IMAGE)
    middle = stepper.step_of_pixel(by_image, (7, 10), 0)
    assert middle is not None
    writes = by_image.write_steps.upto(len(by_image.write_steps))
    moment = moment_at(by_image, int(writes[writes > middle][0]) - 1)
    assert moment.line == by_image.source.write
    assert [(test.pixel, test.object) for test in moment.tests] == [((7, 10), 0), ((7, 10), 1)]
    far, near = moment.tests
    assert near.t < far.t < math.inf
    by_object = recorded(TWO_BALLS, Order.OBJECT)
    second = int(by_object.object_steps[1])
    moment = moment_at(by_object, len(by_object) - 4)
    assert moment.object == 1
    rows, columns = bounding_box(by_object.model.objects[1], by_object.camera, SIZE)
    assert moment.box == (rows, columns)
    assert moment_at(by_object, second).box is None
    assert moment_at(by_object, 1).tests == moment_at(by_image, 1).tests == ()
    assert [test.pixel for test in moment.tests] == [(i, j) for i in rows for j in columns]
    with Tracer(TWO_BALLS) as tracer:
        seen = tracer.render(Camera.canonical(), SIZE).id
    assert {test.pixel for test in moment.tests if test.t < math.inf} == set(
        zip(*np.nonzero(seen == 1), strict=True)
    )


# Ways to go on.


def test_going_to_the_next_pixel_and_object() -> None:
    run = recorded(TWO_BALLS, Order.IMAGE, size=(4, 3))
    step, visited = 0, []
    while (following := stepper.next_pixel(run, step)) < len(run) - 1:
        step = following
        visited.append(moment_at(run, step).pixel)
    assert visited == [(i, j) for i in range(3) for j in range(4)]
    objects = []
    step = 0
    for _ in range(4):
        step = stepper.next_object(run, step)
        objects.append((moment_at(run, step).pixel, moment_at(run, step).object))
    assert objects == [((0, 0), 0), ((0, 0), 1), ((0, 1), 0), ((0, 1), 1)]
    run = recorded(TWO_BALLS, Order.OBJECT, size=(4, 3))
    step = stepper.next_object(run, stepper.next_object(run, 0))
    assert moment_at(run, step).object == 1
    assert stepper.next_object(run, step) == len(run) - 1
    assert stepper.step_of_pixel(run, (0, 0), 0) is None or moment_at(
        run, stepper.step_of_pixel(run, (0, 0), 0)
    ).pixel == (0, 0)


def test_a_pixel_s_next_turn_is_after_the_step_or_else_its_first() -> None:
    """In object order a pixel has one in each object's box."""
    run = recorded(TWO_BALLS, Order.OBJECT)
    first = stepper.step_of_pixel(run, (7, 10), 0)
    assert first is not None and moment_at(run, first).object == 0
    second = stepper.step_of_pixel(run, (7, 10), first)
    assert second is not None and moment_at(run, second).object == 1
    assert moment_at(run, first).pixel == moment_at(run, second).pixel == (7, 10)
    assert stepper.step_of_pixel(run, (7, 10), first - 1) == first
    assert stepper.step_of_pixel(run, (7, 10), second) == first
    assert stepper.step_of_pixel(run, (0, 0), 0) is None  # in no box
    begun = Recording(run.model, run.camera, SIZE, Order.OBJECT)
    assert stepper.step_of_pixel(begun, (7, 10), 0) is None


def test_values_are_told_in_a_few_characters() -> None:
    model = Model(TWO_BOXES)
    (_, near), piece = model.objects, next(triangles(model, Camera.canonical()))
    ray = ViewingRay((0.0, 0.0, 0.0), (0.125, 0.5, -1.0), 0.0, math.inf)
    for value, text in (
        (range(3, 7), "3 to 6"),
        (range(0), "none"),
        (near, "near"),
        (piece, f"far, number {piece.primitive}"),
        (replace(piece, shares=piece.shares[::-1]), f"far, number {piece.primitive}, clipped"),
        (Corner(3.14159, 12.5, 0.25), "(3.14, 12.50), z = 0.2500"),
        ((2.0, 13.5), "(2, 13.5)"),
        (ray, "(0.0000, 0.0000, 0.0000) + t (0.1250, 0.5000, -1.0000)"),
        (MISS, "miss, t = inf"),
        (Hit(2.5, near, 12), "t = 2.5000, near"),
        (0.5, "0.5000"),
        (3, "3"),
    ):
        assert stepper.describe(value) == text


def test_a_moment_before_the_first_or_after_the_last_is_the_first_or_the_last() -> None:
    run = recorded(TWO_BALLS, Order.OBJECT, size=(4, 3))
    assert moment_at(run, -5).step == 0
    assert moment_at(run, 10**9).step == len(run) - 1


# Runs.


def test_a_run_in_the_background_can_be_watched_and_cancelled() -> None:
    scene = load_scene("columns")
    run = Recording(Model(scene), scene.view.for_size((64, 48)), (64, 48), Order.IMAGE)
    thread = run.start()
    assert thread.daemon  # no exit waits for it
    while len(run) < 2000:
        assert thread.is_alive()
    for step in range(0, len(run), 97):
        assert moment_at(run, step).step == step
    run.cancel()
    thread.join()
    assert run.error is None
    assert not run.complete and not run.truncated
    assert len(run) < 400_000
    assert not moment_at(run, len(run)).finished


def test_a_run_ends_at_the_most_steps(monkeypatch) -> None:
    monkeypatch.setattr(recording, "MOST_STEPS", 100)
    run = Recording(Model(TWO_BALLS), Camera.canonical(), SIZE, Order.IMAGE)
    done: list[int] = []
    run.start(lambda: done.append(len(run))).join()
    assert run.truncated and not run.complete and done == [100] and len(run) == 100


def test_a_run_leaves_the_interpreter_to_others_now_and_then(monkeypatch) -> None:
    """After half a second here, of a clock that is looked at every eighth step."""
    run = Recording(Model(TWO_BALLS), Camera.canonical(), (4, 3), Order.IMAGE)
    breaks: list[int] = []
    clock = SimpleNamespace(
        perf_counter=count(100.0, 0.25).__next__, sleep=lambda _: breaks.append(len(run))
    )
    monkeypatch.setattr(recording, "time", clock)
    monkeypatch.setattr(recording, "_BREAK_AFTER_S", 0.5)
    run.run()
    assert breaks == list(range(17, len(run) + 1, 24))


def test_a_failing_run_says_why(monkeypatch) -> None:
    monkeypatch.setattr(loops, "intersect", lambda *_: 1 / 0)
    run = Recording(Model(TWO_BALLS), Camera.canonical(), SIZE, Order.OBJECT)
    run.start().join()
    assert isinstance(run.error, ZeroDivisionError)
    assert moment_at(run, len(run)).line == run.source.test


def test_recording_leaves_tracing_as_it_was() -> None:
    def watching(frame, event, argument):
        return None

    before = sys.gettrace()
    sys.settrace(watching)
    try:
        recorded(TWO_BALLS, Order.IMAGE, size=(2, 2))
        assert sys.gettrace() is watching
    finally:
        sys.settrace(before)


@pytest.mark.parametrize("size", [(0, 3), (65, 3), (4, 49)])
def test_canvases_are_small(size: tuple[int, int]) -> None:
    with pytest.raises(
        LucidaError, match=r"canvas\[[01]\]: \d+ is out of range; give 1 to (64|48)"
    ):
        Recording(Model(TWO_BALLS), Camera.canonical(), size, Order.IMAGE)


@pytest.mark.parametrize("order", Order)
def test_an_empty_scene_and_a_single_pixel(order: Order) -> None:
    run = recorded(Scene((), background=(0.5, 0.5, 0.5)), order, size=(1, 1))
    assert (last(run).canvas == 0.5).all()
    assert last(run).counters.tests == 0
    one = recorded(TWO_BALLS, order, size=(1, 3))
    for step in range(len(one)):
        moment = moment_at(one, step)
        if moment.ray is not None:
            assert moment.pixel is not None
            assert moment.ray.direction[1] == pytest.approx(-((moment.pixel[0] + 0.5) / 3 - 0.5))


# Bounding boxes.


def outline(scene: Scene, camera: Camera) -> tuple[int, int, int, int]:
    """First and last row and column that the tracer sees anything in."""
    with Tracer(scene) as tracer:
        rows, columns = np.nonzero(tracer.render(camera, (240, 180), ("id",)).id >= 0)
    return rows.min(), rows.max(), columns.min(), columns.max()


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("shape", ["sphere", "torus"])
def test_boxes_fit_tightly(shape: str, projection: str) -> None:
    """Also in a skewed basis, seen from the side."""
    one = Sphere((0.4, 0.3, -4), 0.8) if shape == "sphere" else shapes.torus(0.9, 0.3)
    if not isinstance(one, Sphere):
        one = shapes.translate(shapes.rotate(one, (50, 20, 0)), (0.2, 0.1, -4))
    scene = Scene((SceneObject(one),))
    camera = Camera(
        (0.1, 0, 0.5), (1, 0.2, 0.1), (-0.3, 1.1, 0), (0.2, 0.1, 0.9), 1.2,
        (-1, 1, -0.8, 0.7) if projection == "perspective" else (-2.5, 2.5, -2, 2), projection,
    )  # fmt: skip
    rows, columns = bounding_box(Model(scene).objects[0], camera, (240, 180))
    top, bottom, left, right = outline(scene, camera)
    assert 0 < left < right < 239 and 0 < top < bottom < 179
    for first, second in ((rows.start, top), (columns.start, left)):
        assert 0 <= second - first <= 1
    for first, second in ((rows.stop - 1, bottom), (columns.stop - 1, right)):
        assert 0 <= first - second <= 1


def test_boxes_of_what_reaches_behind_the_eye() -> None:
    camera = Camera.canonical()
    floor = shapes.translate(shapes.rectangle(4, 40), (0, -1, 0))
    rows, columns = bounding_box(Model(Scene((SceneObject(floor),))).objects[0], camera, (240, 180))
    # y = -1 is seen below the horizon down to the image's lower edge, the far end at z = -20.
    assert rows.stop == 180 and columns == range(240)
    assert rows.start == math.ceil((0.5 + 1 / 20) * 180 - 0.5)
    assert sphere_extent(np.array([0, 0, 3.0]), 1, camera) == NOTHING
    assert sphere_extent(np.array([0, 0, 0.5]), 1, camera) == EVERYTHING
    behind = np.array([[0, 0, 1.0], [1, 0, 2], [0, 1, 3]])
    assert mesh_extent(behind, np.array([[0, 1, 2]]), camera) == NOTHING
    clipped = Camera(near=2, far=4)
    assert sphere_extent(np.array([0, 0, -1.0]), 0.5, clipped) == NOTHING
    assert sphere_extent(np.array([0, 0, -5.0]), 0.5, clipped) == NOTHING


def test_a_miss_is_infinitely_far() -> None:
    assert tuple(MISS) == (math.inf, None, -1, 0.0, 0.0)


def test_an_object_has_a_name_a_box_and_its_own_triangles() -> None:
    box = shapes.translate(shapes.box((1, 2, 3)), (5, 0, 0))
    scene = Scene((*TWO_BALLS.objects, SceneObject(box), SceneObject(box, name="its twin")))
    far, _, one, twin = Model(scene).objects
    assert (far.name, one.name, twin.name) == ("far", "object 2", "its twin")
    assert (far.low, far.high) == ((-2, -2, -7), (2, 2, -3))
    assert (twin.low, twin.high) == ((4.5, -1, -1.5), (5.5, 1, 1.5))
    assert far.vertices.shape == far.faces.shape == (0, 3)
    for thing in (one, twin):
        assert thing.faces.shape == (12, 3) and len(thing.vertices) == thing.faces.max() + 1
        assert (np.abs(thing.vertices - (5, 0, 0)) == (0.5, 1, 1.5)).all()


def test_a_line_meets_a_box_where_no_axis_parts_them() -> None:
    """Touching it, too; flat boxes, and lines along an axis. No plane of two axes parts them: the
    separating axis theorem."""
    rng = np.random.default_rng(5)
    met = 0
    for _ in range(3000):
        corners, origin, direction = rng.integers(-2, 3, (3, 2, 3))
        low, high = corners.min(axis=0), corners.max(axis=0)
        origin, direction = origin[0], direction[0]
        if not direction.any():
            continue
        # Of twice the box, so that its middle is a whole number.
        parted = np.abs(np.cross(2 * origin - low - high, direction))
        half = high - low
        reach = np.abs(direction) @ np.array(
            [[0, *half[[2, 1]]], [half[2], 0, half[0]], [half[1], half[0], 0]]
        )
        expected = bool((parted <= reach).all())
        box = tuple(map(float, low)), tuple(map(float, high))
        found = _meets_box(*box, tuple(map(float, origin)), tuple(map(float, direction)))
        assert found is expected
        met += expected
    assert 500 < met < 2500
