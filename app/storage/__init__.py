"""What outlives the window: sessions, recent files, pictures, the clipboard.

session         what was open, as text; session_store: where it is kept
scene_watch     whether the files of the scene that is shown have been saved anew
"""
