"""The box that exports a figure: what is seen in it is written."""

import io
import xml.etree.ElementTree as ElementTree
from dataclasses import replace

import numpy as np
from PIL import Image
from window_driver import Key

from lucida.app.window.figure_box import FigureBox
from lucida.app.window.figure_choice import FigureChoice
from lucida.app.window.figures import encoder

SPACE = "{http://www.w3.org/2000/svg}"


def _open(d):
    d.press(Key.mod_ctrl | Key.mod_shift | Key.e)
    d.frames(3)
    box = d.window.box
    assert isinstance(box, FigureBox)
    return box


def drive_the_box_saves_the_figure_that_it_shows(d):
    d.change(marked=(60, 90), outside={"bundle": (2, 2)})
    d.settle()
    box = _open(d)
    box.choice = replace(box.choice, size=(400, 300), ground="transparent")
    d.frames(2)
    d.ctx.item_click("//Export figure/Save...")
    dialog = d.files.dialog
    d.until(lambda: dialog.is_open)
    question = dialog.question
    assert question.saves and question.endings == (".svg", ".pdf", ".png")
    dialog.cancel()
    question.chosen([str(d.folder / "figure")])
    d.settle()
    assert d.files.message == ""
    root = ElementTree.parse(d.folder / "figure.svg").getroot()
    (image,) = root.iter(f"{SPACE}image")
    assert (image.get("width"), image.get("height")) == ("400", "300")
    assert not list(root.iter(f"{SPACE}rect"))
    assert {"edges", "image plane", "ray", "u", "eye"} <= {
        one.get("data-name") for one in root.iter()
    }
    assert {"".join(one.itertext()) for one in root.iter(f"{SPACE}text")} >= {"u", "v", "w", "e"}


def drive_images_and_formulas_are_figures_too(d):
    d.change(marked=(60, 90))
    d.window.show_in("Probe", "Probe")
    d.until(lambda: "Probe" in d.stage.rects and not d.window.is_rearranging)
    d.settle()
    choice = FigureChoice(size=(600, 200), ground="transparent")
    for what, least in (("pair", 0.3), ("raster", 0.15), ("probe", 0.001)):
        made = d.in_draw_lists(lambda what=what: encoder(d.window, replace(choice, what=what)))
        pixels = np.asarray(Image.open(io.BytesIO(made(".png"))))
        assert pixels.shape == (200, 600, 4)
        assert least < (pixels[..., 3] > 127).mean() < 0.9, what
        assert pixels[0, 0, 3] == 0
    assert b"align*" in encoder(d.window, replace(choice, what="probe"))(".tex")
