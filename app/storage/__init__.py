"""Everything that outlives the window: sessions, recent files, pictures, the clipboard.

session         what was open, as text; session_store: the place of it
scene_watch     whether the files of the shown scene were saved again
"""
