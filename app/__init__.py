"""Lucida's window and command line, over the packages in renderer/. A package imports from its own
layer and from those below it in this list (docs/architecture.md).

commands/, window/                         the command line; the open window
instruments/, lecture/, checking/, web/    the instruments; lectures; students' code; HTML pages
images/, cameras/, ui/                     both images; the camera as the user moves it; widgets
state/                                     everything that undo, sessions and lectures keep
"""
