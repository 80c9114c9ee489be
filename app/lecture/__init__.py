"""The guided lecture: files of steps, their texts, their exercises, and the column that shows them.

schema      the file format, as msgspec structures
places      the line of each field in a TOML text
text        Markdown with formulas, into blocks to draw
exercises   questions with checked answers
model       the lecture: steps, parts, outline
reading     a file into a lecture; errors with file, line and field
states      a step's state of the window; view, slide, exercise: on the screen
"""
