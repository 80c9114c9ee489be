"""The two images as textures that ImGui can show.

Owns the rasterizer and the display transform in the window's context, and redraws only what has
changed. The rasterizer is made when it first draws: where a driver does not take its shaders, that
is an error of drawing, and the window has the ray image. Knows nothing of widgets and of how the
ray image was made.
"""

from __future__ import annotations

import contextlib
import functools
import time
from dataclasses import dataclass

import moderngl
from numpy.typing import NDArray

from app.images.coarseness import Coarseness
from app.images.placement import Placement
from app.images.progressive_raster import Drawing, Pace
from app.images.progressive_ray import RayImage
from app.images.readback import Reading, Region
from app.images.shown import Picture, Range, ShownImage, whole
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.frame import Frame
from renderer.raster import DepthRange, Look, Prepared, Rasterizer, upload
from renderer.raster.targets import Textures
from renderer.scene.model import Scene

FAILURES = (LucidaError, moderngl.Error, MemoryError)  # of drawing: told, and survived
MOVING_S = 0.1  # after a change, at least, before a full raster image: the ray image comes first
FRAME_S = 0.0035  # what a raster image may take of a frame while the camera moves
COARSEST = 4
PLACES = {False: ("", "full too"), True: ("coarse", "coarse too")}  # by whether it is coarse
ATTEMPTS = 3  # at putting an image on the GPU, one a frame

PANE, WHOLE = "pane", "whole"


@dataclass(frozen=True)
class Wanted:
    """What a raster image depends on, but for how it is shown. size: (width, height)."""

    scene: Scene
    camera: Camera
    size: tuple[int, int]


class Pictures:
    """Both images, in the window's context, which must be current in every call."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._raster, self._ray = ShownImage(context), ShownImage(context)
        self._range = DepthRange(context)
        self._made: Rasterizer | None = None
        self._not_made: Exception | None = None
        self._scene: Scene | None = None  # of the rasterizer's
        self._prepared: list[tuple[Scene, Prepared]] = []
        self._timer = context.query(time=True)
        self._timed = False  # whether a part's time is still to be read
        self._complete: Drawing | None = None  # likewise of an image
        self._coarseness, self._pace = Coarseness(FRAME_S, FRAME_S, COARSEST), Pace()
        self._wanted: Wanted | None = None
        self._textures: Textures | None = None
        self._place: str | None = None  # where those are
        self._asked: Wanted | None = None  # the newest, whether or not it is drawn already
        self._factor = 1  # of what is asked for
        self._under_way: tuple[Wanted, Drawing] | None = None
        self._refining = False  # whether that is for sharpness only
        self._advanced = -1  # the frame in which that was gone on with
        self._drawing_s = 0.0  # measured of what is under way
        self._drawn = 0
        self._values: tuple[object, NDArray] | None = None
        self._changed_s = 0.0
        self._reading: Reading | None = None
        self._depths: Range | None = None
        self._depths_of: object = None  # the image whose range that is
        self._frame = 0
        self._raster_frame = -1  # the last one that showed the raster image
        self._image: RayImage | None = None
        self._ray_texture: moderngl.Texture | None = None
        self._uploaded: tuple[RayImage, str] | None = None
        self._failures = 0
        self.raster_factor = 1
        self.raster_s = 0.0
        self.raster_error: Exception | None = None
        self.ray_error: Exception | None = None

    @property
    def _rasterizer(self) -> Rasterizer:
        """Raises again what making it has raised, until retry(): compiling takes many frames."""
        if self._not_made is not None:
            raise self._not_made
        if self._made is None:
            try:
                self._made = Rasterizer(Scene(()), context=self._gl)
            except FAILURES as error:
                self._not_made = error
                raise
        return self._made

    def retry(self) -> None:
        """Makes the rasterizer again, if that has failed, and puts the ray image on the GPU;
        drawing is tried in each frame."""
        self._not_made, self._failures = None, 0

    def prepare(self, scene: Scene, prepared: Prepared) -> None:
        """Keeps what a scene was prepared as, which takes long, for when it is shown: of the last
        one, and of the one before it, for undo."""
        self._prepared = [*self._prepared, (scene, prepared)][-2:]

    def begin_frame(self) -> None:
        """Once a frame, before anything else."""
        self._frame += 1
        self._raster.begin_frame()
        self._ray.begin_frame()
        self._read_time()
        self._range.numbers()  # whether or not somebody will ask: then nothing is left to do

    def raster(self, wanted: Wanted, look: Look) -> moderngl.Texture | None:
        """All of the raster image at its own size, otherwise as raster_in()."""
        picture = self.raster_in(whole(wanted.size), wanted, look, WHOLE)
        return picture.texture if picture is not None else None

    def raster_in(
        self,
        placement: Placement,
        wanted: Wanted,
        look: Look,
        name: str = PANE,
        under: bool = False,
        own_size: bool = False,
    ) -> Picture | None:
        """The raster image as it is seen in a window, drawn anew if it must be. name, under,
        own_size: see ShownImage.picture.

        None where that failed, see raster_error. Where OpenGL runs on the CPU, the image is coarse
        while things move, and full soon after.
        """
        try:
            drawn = self._follow(wanted)
            self._raster_frame = self._frame
            if look.channel == "depth":
                self._measure(self._drawn, drawn.surface)
            picture = self._raster.picture(name, look, placement, self._depths, under, own_size)
            self.raster_error = None
        except FAILURES as error:  # shown in the window, which goes on
            self._forget_image()
            self.raster_error, self.raster_factor = error, 1
            return None
        return picture

    @property
    def raster_number(self) -> int:
        """Of the raster image that is shown: another one, another number."""
        return self._drawn

    def textures(self, wanted: Wanted) -> tuple[Textures, int] | None:
        """All channels of the raster image, if that is drawn, and full; and its number, as linear()
        gives it. They are drawn over by the next image."""
        if wanted != self._wanted or self._textures is None or self.raster_factor > 1:
            return None
        return self._textures, self._drawn

    def linear(self, wanted: Wanted) -> tuple[moderngl.Texture, int]:
        """The raster image in linear light, drawn anew if it must be, and how many have been drawn:
        the number changes with the image. Raises LucidaError."""
        return self._follow(wanted).color, self._drawn

    def beside(self, wanted: Wanted, place: str) -> Textures:
        """Another camera's image of the scene, kept beside the raster image, which stays. Drawn
        by each call; place: see Rasterizer.draw. Raises LucidaError."""
        self._show(wanted.scene)
        return self._rasterizer.draw(wanted.camera, wanted.size, place)

    def take_ray(self, image: RayImage) -> None:
        """The traced image to show from now on."""
        self._image, self._failures = image, 0

    def ray_in(
        self,
        placement: Placement | None,
        look: Look,
        name: str = PANE,
        under: bool = False,
        own_size: bool = False,
    ) -> Picture | None:
        """The last traced image as it is seen in a window; without a placement, all of it. None
        before the first, and where putting it on the GPU failed, see ray_error."""
        image = self._image
        if image is None or self._failures >= ATTEMPTS:
            return None
        try:
            self._upload(image, look.channel)
            if look.channel == "depth" and self._raster_frame < self._frame - 1:
                self._measure(self._uploaded, self._ray_texture)  # the raster image is not seen
            placement = placement or whole(image.request.size)
            picture = self._ray.picture(name, look, placement, self._depths, under, own_size)
            self.ray_error = None
        except FAILURES as error:
            self._ray.set_channels({})
            self._uploaded, self.ray_error = None, error
            self._failures += 1
            return None
        return picture

    def depths(self) -> tuple[float, float] | None:
        """The ray parameters shown white and darkest, of the frame before; None: nothing is hit."""
        return self._range.numbers()

    @property
    def shows_ray(self) -> bool:
        """Whether there is a ray image on the screen."""
        return not self._ray.is_empty

    @property
    def unfinished(self) -> bool:
        """Whether the next frames have something to do: refine, try again, or read what the last
        one has measured."""
        seen = self._raster_frame >= self._frame - 1
        return (
            (seen and (self.raster_factor > 1 or self._under_way is not None))
            or self._timed
            or 0 < self._failures < ATTEMPTS
            or self._range.unfinished
        )

    def read_back(self, wanted: Wanted) -> Frame | None:
        """All channels of the full raster image as arrays, a part a call: None until the last.
        Raises LucidaError."""
        if wanted != self._wanted or self.raster_factor > 1:
            self._refine(wanted)  # and to be read from the next frame on
            return None
        if self._reading is None or self._reading.of != wanted:
            assert self._place is not None
            read = functools.partial(self._rasterizer.read, place=self._place)
            self._reading = Reading(wanted, wanted.size, read)
        frame = self._reading.go_on()
        if frame is not None:
            self._reading = None
        return frame

    def raster_values(self, wanted: Wanted, channel: str, region: Region) -> NDArray | None:
        """A channel's values in some pixels of the raster image, if that is drawn, and full; else
        None. region: first row and column, one past the last of each. Waits for the GPU."""
        if wanted != self._wanted or self.raster_factor > 1:
            return None
        if self._values is not None and self._values[0] == (self._drawn, channel, region):
            return self._values[1]
        assert self._place is not None
        values = self._rasterizer.read((channel,), region, self._place)[channel]
        self._values = ((self._drawn, channel, region), values)
        return values

    def release(self) -> None:
        with contextlib.suppress(moderngl.Error):
            if self._made is not None:
                self._made.release()
            self._raster.release()
            self._ray.release()
            self._range.release()
            if self._ray_texture is not None:
                self._ray_texture.release()

    def _follow(self, wanted: Wanted) -> Textures:
        """The newest complete image: of an older camera where an image takes several frames."""
        if wanted != self._asked:
            self._asked, self._changed_s = wanted, time.monotonic()
            width, height = wanted.size
            self._factor = self._coarseness.changed(width * height, self._changed_s)
        if self._under_way is not None and self._is_in_vain(wanted):
            self._under_way = None
        if self._under_way is None:
            still_s = time.monotonic() - self._changed_s
            if wanted != self._wanted or self._textures is None:
                self._begin(wanted)
            elif self.raster_factor > 1 and still_s > max(MOVING_S, self._coarseness.rest_s):
                self._begin(wanted, refining=True)
        self._go_on()
        assert self._textures is not None
        return self._textures

    def _refine(self, wanted: Wanted) -> None:
        """Goes on with the full image."""
        if self._under_way is None or self._under_way[0] != wanted:
            self._begin(wanted, refining=True)
        self._go_on()

    def _is_in_vain(self, wanted: Wanted) -> bool:
        """Whether what is under way would show too old a thing: an image of a motion is finished,
        so that the motion always shows something new."""
        assert self._under_way is not None
        of, _ = self._under_way
        return of.scene is not wanted.scene or (self._refining and of != wanted)

    def _begin(self, wanted: Wanted, refining: bool = False) -> None:
        """refining: the full image, over as many frames as it takes."""
        self._show(wanted.scene)
        factor = 1 if refining else self._factor
        shown = self._wanted if self._textures is not None else None
        has_any = shown is not None and shown.scene is wanted.scene
        width, height = wanted.size
        self._under_way = (
            wanted,
            Drawing(
                self._rasterizer,
                wanted.camera,
                wanted.size,
                factor,
                PLACES[factor > 1],
                self._place,
                self._pace,
                expected_s=self._coarseness.full_s(width * height) if refining else 0.0,
                at_once=not has_any,
            ),
        )
        self._refining, self._drawing_s, self._advanced = refining, 0.0, -1

    def _go_on(self) -> None:
        """Once a frame, however many ask."""
        if self._under_way is None or self._advanced == self._frame:
            return
        (wanted, drawing), self._under_way = self._under_way, None  # also if it fails
        try:
            with self._timer:
                drawn = drawing.go_on()
        except FAILURES:
            self._forget_image()  # it may be drawn over
            raise
        self._timed = True
        if drawn is not None:
            self._take(wanted, drawing, drawn)
        else:
            self._under_way, self._advanced = (wanted, drawing), self._frame

    def _forget_image(self) -> None:
        self._raster.set_channels({})
        self._wanted, self._textures, self._place = None, None, None
        self._under_way, self._reading = None, None

    def _take(self, wanted: Wanted, drawing: Drawing, drawn: Textures) -> None:
        self._raster.set_channels(
            {
                "color": drawn.color,
                "depth": drawn.surface,
                "normal": drawn.surface,
                "id": drawn.object,
            }
        )
        self._drawn += 1
        self._wanted, self._textures, self.raster_factor = wanted, drawn, drawing.factor
        self._place, self._reading = drawing.place, None
        self._complete = drawing

    def _upload(self, image: RayImage, channel: str) -> None:
        """Only what is shown: a channel of a large image is 100 MB."""
        if getattr(image.frame, channel) is None:  # coarse, and begun before the channel was
            if self._uploaded is not None:  # chosen: the last image stays a moment longer
                return
            channel = "color"
        if self._uploaded == (image, channel):
            return
        texture, self._ray_texture = self._ray_texture, None
        self._ray_texture = upload(self._gl, image.frame.channel(channel), texture)
        self._ray.set_channels({channel: self._ray_texture})
        self._uploaded = (image, channel)

    def _measure(self, image: object, texture: moderngl.Texture | None) -> None:
        if texture is None or self._depths_of == image:
            return
        number = self._depths.number + 1 if self._depths is not None else 0
        self._depths = Range(self._range.measure(texture), number)
        self._depths_of = image

    def _read_time(self) -> None:
        """A frame later: at once, it would wait for the GPU."""
        if not self._timed:
            return
        self._timed = False
        self._drawing_s += self._timer.elapsed * 1e-9
        if self._complete is not None:
            drawing, self._complete = self._complete, None
            self.raster_s = self._drawing_s
            width, height = drawing.size
            self._coarseness.measured(drawing.factor, width * height, self.raster_s)

    def _show(self, scene: Scene) -> None:
        if scene is not self._scene:
            known = next((known for of, known in self._prepared if of is scene), None)
            self._rasterizer.set_scene(scene, known)
            self._scene = scene
