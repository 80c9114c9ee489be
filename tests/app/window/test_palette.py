"""The command palette's search, and the words for what undo does."""

import pytest

from lucida.app.lecture import schema
from lucida.app.state.app_state import AppState
from lucida.app.ui.action import chords_of
from lucida.app.window.action_table import ACTIONS, MENUS
from lucida.app.window.instruments import INSTRUMENTS, make_views
from lucida.app.window.palette_entries import SYNONYMS, pages
from lucida.app.window.palette_search import Entry, found
from lucida.app.window.shortcut_sheet import in_columns, sections
from lucida.renderer.files import load_scene

ENTRIES = [
    Entry("Parallel projection", "Camera", lambda: None, "P"),
    Entry("Save a picture of the window", "File > Picture", lambda: None, "F12"),
    Entry("Presentation", "View", lambda: None, "F9"),
    Entry("Dark theme", "View > Theme", lambda: None),
    Entry("Light theme", "View > Theme", lambda: None),
    Entry("Scene: spheres", "File > Built-in scenes", lambda: None),
]


def names(query, recent=()):
    return [entry.name for entry in found(query, ENTRIES, recent)]


@pytest.mark.parametrize(
    ("query", "first"),
    [
        ("pres", "Presentation"),
        ("par", "Parallel projection"),
        ("pp", "Parallel projection"),
        ("spw", "Save a picture of the window"),
        ("picture", "Save a picture of the window"),
        ("LIGHT", "Light theme"),
        ("spheres", "Scene: spheres"),
        ("built in spheres", "Scene: spheres"),
    ],
)
def test_a_few_letters_find_it(query, first):
    assert names(query)[0] == first


def test_everything_is_there_without_a_query_and_nothing_for_nonsense():
    assert names("") == [entry.name for entry in ENTRIES]
    assert names("xyzzy") == []


def test_recently_used_stand_first():
    recent = (ENTRIES[4].key, ENTRIES[2].key)
    assert names("", recent)[:2] == ["Light theme", "Presentation"]
    assert names("theme", recent)[0] == "Light theme"
    assert names("dark", recent)[0] == "Dark theme"  # what fits better wins


TABLE = [
    Entry(action.name, action.menu, lambda: None, also=SYNONYMS.get(action.name, ""))
    for action in ACTIONS
]
TITLES = [" ".join(view.title.split()) for view in make_views()]
VIEWS = [
    Entry(f"Go to {title}", "Instruments", lambda: None, also=SYNONYMS.get(title, ""))
    for title in TITLES
]
PAGES = pages(None)  # which only running them needs


@pytest.mark.parametrize(
    ("query", "wanted"),
    [
        ("fov", "Go to Camera"),
        ("ortho", "Parallel projection"),
        ("grid", "Pixel grid and values"),
        ("diagram", "Export figure..."),
        ("screenshot", "Save a picture of the window"),
        ("zoom", "Magnify"),
        ("gamma", "Linear light (no sRGB curve)"),
        ("count from", "Pixels from 1 (lecture)"),
        ("subpixel", "Image laboratory: Displays"),
        ("lights", "Add point light"),
    ],
)
def test_the_words_of_other_programs_find_what_is_meant(query, wanted):
    best = [entry.name for entry in found(query, [*TABLE, *VIEWS, *PAGES])][:4]
    assert wanted in best


def test_pages_are_options_of_their_instruments():
    state = AppState.for_scene(load_scene("still-life"))
    for instrument in INSTRUMENTS:
        for name, changes in instrument.pages.items():
            changed = state.options.with_changes(changes)
            for part, options in changes.items():
                assert options.items() <= vars(getattr(changed, part)).items(), name


def test_whole_words_stand_before_letters_that_lie_apart():
    entries = [Entry("Go right, in depth", "", lambda: None), Entry("Pixel grid", "", lambda: None)]
    assert found("grid", entries)[0].name == "Pixel grid"


def test_synonyms_name_what_there_is():
    names = {entry.name for entry in (*TABLE, *PAGES)} | set(TITLES)
    assert SYNONYMS.keys() <= names


def test_every_key_is_bound_once_and_every_action_is_in_a_menu():
    chords = [chord for action in ACTIONS for chord in action.chords]
    assert len(chords) == len(set(chords))
    assert {action.menu.split("/")[0] for action in ACTIONS} <= set(MENUS)
    full = [(action.menu, action.name) for action in ACTIONS]
    assert len(full) == len(set(full))


def test_the_sheet_holds_every_key_and_fits_columns():
    parts = sections()
    text = " ".join(keys for _, rows in parts for keys, _ in rows)
    for action in ACTIONS:
        if action.keys and not any(c.isdigit() for c in action.name):
            assert action.keys in text, action
    assert "1 to 9" in text
    for columns in (1, 2, 3):
        placed = in_columns(parts, columns)
        assert len(placed) <= columns
        assert sorted(part for column in placed for part in column) == sorted(parts)
        heights = [sum(len(rows) + 2 for _, rows in column) for column in placed]
        assert max(heights) <= 1.1 * sum(heights) / columns, "of about one height"
        for column in placed:
            assert column == sorted(column, key=parts.index), "in their order"


def test_a_plus_is_a_plus_with_or_without_shift():
    """On many keyboards + stands above =."""
    plus = [action for action in ACTIONS if action.keys.endswith("+")]
    assert len(plus) == 3
    for action in plus:
        unshifted = chords_of(f"{action.keys[:-1]}equal")
        shifted = chords_of(f"{action.keys[:-1]}Shift+equal")
        assert {*unshifted, *shifted} <= set(action.chords), action.name


def test_every_view_that_lectures_can_show_is_in_the_window():
    assert set(schema.VIEWS) <= {view.name.lower() for view in make_views()}
