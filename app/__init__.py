"""Lucida's window and command line, over the packages in renderer/."""

__version__ = "0.1.0"
