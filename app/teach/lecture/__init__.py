"""The guided lecture's core: files of steps, their texts, their exercises, their states.

schema      the file format, as msgspec structures
places      the line of each field in a TOML text
text        Markdown with formulas, into blocks to draw
answers     numbers and vectors as students type them
mistakes    the classic wrong lines of a camera, to know a wrong answer by
exercises   questions with checked answers
model       the lecture: steps, parts, outline
reading     a file into a lecture; errors with file, line and field
watching    whether the file has changed while it is edited
states      a step's state of the window
"""
