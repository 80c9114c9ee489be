"""The image laboratory: every drawing in the window, and its light at the pointer."""

import itertools
import pickle

from alone import Alone

from lucida.app.instruments.laboratory.pages import PAGES
from lucida.app.instruments.laboratory.view import LaboratoryView
from lucida.app.instruments.outside.figure import Label

ALONE = Alone(LaboratoryView, "laboratory")


def drive_every_page_is_drawn_and_moves(d):
    view = ALONE.open(d)
    for page, kind in PAGES.items():
        seen = []
        for progress in sorted({0.0, float(kind.builds)}):
            options = {"page": page, "progress": progress}
            d.change(laboratory=options)
            d.settle()
            assert view.figure.parts
            seen.append(pickle.dumps(view.figure.parts))
        for one, other in itertools.pairwise(seen):
            assert one != other, page
    d.picture()


def drive_the_pointer_reads_the_image(d):
    view = ALONE.open(d, page="function", progress=1.0)

    def words():
        return [part.text for part in view.figure.parts if isinstance(part, Label)]

    box, texts = d.box(ALONE.item("image")), []
    for part in (0.02, 0.5):  # the background, and what is in the middle
        x = box.min.x + part * (box.max.x - box.min.x)
        y = box.min.y + part * (box.max.y - box.min.y)
        d.move_to((x, y))
        texts.append(words())
    assert texts[0] != texts[1] and "schematic" in texts[1]
