"""Lucida's window and command line, over the packages in renderer/. A room imports from
those below it here (docs/architecture.md).

commands/     the command line
window/       the window while it is open, and what stands around its views
camera_panel/ pair/ compare/ outside/ probe/
stepper/ costs/ laboratory/ lecture/   an instrument each; instruments.py lists them
host/         what a view is, what an action is, and what both may ask of the window
images/       both images, made, compared and shown
cameras/      the camera in the user's hands; storage/ what outlives the window
widgets/      what panels are made of
explaining/   what several instruments explain with; lectures/ the built-in lecture
state/        all that undo, sessions and lectures keep; changes flow one way, by new states
"""

__version__ = "0.1.0"
