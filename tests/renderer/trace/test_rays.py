"""Single rays on the wide trees against the scalar reference."""

import numpy as np
import pytest
from scenes import crowd
from trace_reference import ball, cast, tree_of

from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Mesh, Scene, SceneObject, Sphere
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer
from lucida.renderer.trace.bvh.instances import Instances
from lucida.renderer.trace.rays.query import closest_hits
from lucida.renderer.trace.threads.thread_pool import Team

# float32, relative to the origin: corners, shear and t are each rounded a few times. For a ray that
# grazes a triangle, or meets it near its origin, that counts for more.
T_RELATIVE, T_GRAZING = 2e-6, 1e-4


@pytest.fixture
def team():
    made = Team(2)
    yield made
    made.close()


def stretched():
    mesh = ball(20, 30)
    random = np.random.default_rng(5)
    objects = [SceneObject(Sphere((0, 2, 0), 0.5))]
    for _ in range(6):
        transform = np.eye(4)
        transform[:3, :3] = random.normal(size=(3, 3)) * 0.5
        transform[:3, 3] = random.uniform(-2, 2, 3)
        objects.append(SceneObject(Mesh(mesh.vertices, mesh.faces, transform=transform)))
    return Scene(tuple(objects))


def alone():
    """One object where its mesh is, for which there is neither an upper tree nor a transform."""
    return Scene((SceneObject(ball(40, 60)),))


def alone_and_moved():
    return Scene(stretched().objects[2:3])


@pytest.mark.parametrize("make", [crowd, stretched, alone, alone_and_moved])
def test_the_closest_hit_is_the_references(make, team):
    scene = make()
    flat = flatten(scene)
    instances = Instances(scene, flat, team)
    random = np.random.default_rng(6)
    origins = random.uniform(-3, 3, (50_000, 3)).astype(np.float32)
    directions = random.normal(size=(50_000, 3)) * 10 ** random.uniform(-3, 3, (50_000, 1))
    directions = directions.astype(np.float32)
    directions[:5000, :2] = 0  # along an axis
    for t_min, t_max in ((0.0, np.inf), (0.3, 1.0)):
        t, primitive = closest_hits(instances, team, origins, directions, t_min, t_max)
        exact_t, exact, *_ = cast(
            tree_of(flat), origins.astype(float), directions.astype(float), t_min, t_max
        )
        same = primitive == exact
        # What differs is grazed, or met within rounding of a limit or of an edge.
        assert np.count_nonzero(~same) < 12
        hit = same & (primitive >= 0)
        assert np.count_nonzero(hit) > 100
        error = np.abs(t[hit] / exact_t[hit] - 1)
        assert np.quantile(error, 0.98) < T_RELATIVE
        assert np.quantile(error, 0.999) < T_GRAZING
        assert np.isposinf(t[primitive < 0]).all()


def test_no_leak_in_a_closed_mesh(team):
    mesh = ball(60, 80)
    scene = Scene((SceneObject(mesh),))
    instances = Instances(scene, flatten(scene), team)
    random = np.random.default_rng(7)
    vertices = mesh.vertices[mesh.faces]
    for part in (0.0, 0.5, random.uniform(size=(len(vertices), 3, 1))):
        # At vertices, and at points of edges.
        targets = vertices + part * (np.roll(vertices, 1, axis=1) - vertices)
        targets = targets.reshape(-1, 3)
        origins = random.uniform(-0.4, 0.4, (len(targets), 3)).astype(np.float32)
        ways = (targets - origins).astype(np.float32)
        assert (closest_hits(instances, team, origins, ways)[1] >= 0).all()
    origins = random.uniform(-0.4, 0.4, (500_000, 3)).astype(np.float32)
    ways = random.normal(size=origins.shape).astype(np.float32)
    assert (closest_hits(instances, team, origins, ways)[1] >= 0).all()


def test_rays_that_are_none_hit_nothing(team):
    scene = stretched()
    instances = Instances(scene, flatten(scene), team)
    origins = np.zeros((3, 3), np.float32)
    directions = np.array([[0, 0, 0], [np.nan, 1, 0], [np.inf, 0, 0]], np.float32)
    t, primitive = closest_hits(instances, team, origins, directions)
    assert (primitive == -1).all()
    assert np.isposinf(t).all()
    none = np.zeros((0, 3), np.float32)
    t, primitive = closest_hits(instances, team, none, none)
    assert len(t) == len(primitive) == 0


def test_nothing_is_hit_in_an_empty_scene(team):
    scene = Scene(())
    instances = Instances(scene, flatten(scene), team)
    rays = np.zeros((5, 3), np.float32), np.ones((5, 3), np.float32)
    assert (closest_hits(instances, team, *rays)[1] == -1).all()


def test_a_tracer_takes_batches():
    scene = stretched()
    origins, directions = [[0, 2, 5], [0, 9, 5]], [[0, 0, -2], [0, 0, -2]]
    with Tracer(scene, threads=2) as tracer:
        t, primitive = tracer.closest_hits(origins, directions)
        assert t[0] == pytest.approx(2.25)
        assert primitive.tolist() == [len(flatten(scene).faces), -1]
        assert (tracer.closest_hits(origins, directions, 0, 2.2)[1] == -1).all()
        with pytest.raises(LucidaError, match="n x 3"):
            tracer.closest_hits([0, 1, 2], [[0, 0, 1]])
        with pytest.raises(LucidaError, match="one per ray"):
            tracer.closest_hits(np.zeros((2, 3)), np.ones((1, 3)))
    with pytest.raises(LucidaError, match="closed"):
        tracer.closest_hits(origins, directions)
    with (
        Tracer(scene, method="reference") as tracer,
        pytest.raises(LucidaError, match="takes no batches"),
    ):
        tracer.closest_hits(origins, directions)


def test_batches_of_any_length_and_rays_along_an_axis(team):
    scene = alone()
    instances = Instances(scene, flatten(scene), team)
    for axis in range(3):
        for zero in (0.0, -0.0):
            directions = np.full((40, 3), zero, np.float32)
            directions[:, axis] = -1
            origins = np.random.default_rng(9).uniform(-0.3, 0.3, (40, 3))
            origins[:, axis] = 5
            for count in (1, 2, 40):
                t, primitive = closest_hits(instances, team, origins[:count], directions[:count])
                assert (primitive >= 0).all(), (axis, count)
                assert ((t > 3) & (t < 5)).all()
                back = closest_hits(instances, team, origins[:count], -directions[:count])
                assert (back[1] == -1).all()
