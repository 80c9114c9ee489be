"""Lucida's window and command line, over the packages in renderer/.

viewer, window   the program and its window; views/ one module a window inside it, over panels/
state, options   all that undo, sessions and lectures keep; changes flow one way, by new states
actions/         menus, keys and palette as one table
cameras/         the camera in the user's hands; images/ both images, made, compared and shown
storage/         files, sessions, settings; outside/ the diagram of camera and rays
teach/           the instruments' numbers, without a window; lectures/ the built-in lecture
commands/        the command line; platform is the only importer of glfw
"""

__version__ = "0.1.0"
