"""Other names for what the window can do: the words of other programs and of other books.

The command palette finds an entry by these as by its name. Keys: names of actions, titles of views.
Each instrument has its own list; this one is the window's.
"""

from __future__ import annotations

from app.window.instruments import INSTRUMENTS

OWN = {
    "Open...": "load import model mesh",
    "Open photograph...": "background image picture overlay backdrop load png jpg",
    "Save view...": "export camera",
    "Save scene": "export",
    "Export...": "mitsuba pbrt gltf glb xml save scene camera renderer",
    "Save a picture of the window": "screenshot capture image png",
    "Save a picture of the view in use": "screenshot capture image png",
    "Copy a picture of the window": "screenshot clipboard",
    "Copy a picture of the view in use": "screenshot clipboard",
    "Quit": "exit close end",
    "Undo": "revert",
    "Redo": "repeat",
    "Maximise the view": "maximize",
    "Full screen": "fullscreen",
    "Presentation": "projector hall slides lecture big",
    "Larger type": "font size bigger text",
    "Smaller type": "font size text",
    "Type at 100 %": "font size text reset",
    "Dark theme": "mode colors colours night",
    "Light theme": "mode colors colours bright day",
    "Find a command": "palette search",
    "Mouse and keys": "help shortcuts keyboard hotkeys bindings about version",
    "Shadows (ray image only)": "shadow",
    "Mirrors (ray image only)": "reflection reflections",
}

SYNONYMS = OWN | {name: also for one in INSTRUMENTS.values() for name, also in one.synonyms.items()}
