"""Lucida's window and command line, over the packages in renderer/. A room imports only from those
below it in this list (docs/architecture.md).

commands/     the command line
window/       the open window, and the parts around its views
camera_panel/ pair/ compare/ outside/ probe/
stepper/ costs/ laboratory/ lecture/   one instrument each; instruments.py lists them
host/         views and actions, and what both may ask of the window
images/       both images: made, compared and shown
cameras/      the camera as the user moves it; storage/ everything that outlives the window
widgets/      the parts that panels are made of
explaining/   shared means of explaining; lectures/ the built-in lecture
state/        everything that undo, sessions and lectures keep; changes flow one way, by new states
"""

__version__ = "0.1.0"
