"""The outside view as a figure in a file."""

import xml.etree.ElementTree as ElementTree

from window_driver import Key

SPACE = "{http://www.w3.org/2000/svg}"


def _store(d, path):
    """Answers the window's own dialog and reads what was written."""
    dialog = d.files.dialog
    d.until(lambda: dialog.is_open)
    question = dialog.question
    assert question.saves and question.endings == (".svg",)
    dialog.cancel()
    question.chosen([str(path)])
    d.until(lambda: not d.files.busy)
    d.settle()
    assert d.files.message == ""
    return ElementTree.parse(f"{path}.svg").getroot()


def drive_the_diagram_is_exported_as_it_is_seen(d):
    d.change(marked=(60, 90), outside={"bundle": (2, 2)})
    d.settle()
    d.press(Key.mod_ctrl | Key.mod_shift | Key.e)
    root = _store(d, d.folder / "first")
    assert root.tag == f"{SPACE}svg"
    (image,) = root.iter(f"{SPACE}image")
    assert (image.get("width"), image.get("height")) == (root.get("width"), root.get("height"))
    names = {part.get("data-name") for part in root.iter()}
    assert {"edges", "image plane", "ray", "u", "eye"} <= names, names
    d.menu("File/Picture/Export figure as SVG without a ground...")
    third = _store(d, d.folder / "third")
    assert list(third.iter(f"{SPACE}image")) and not list(third.iter(f"{SPACE}rect"))
