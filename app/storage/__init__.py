"""Everything that outlives the window: sessions, recent files, pictures, the clipboard.

session         what was open, as text; session_store: the place of it
watching        changes of the files of the shown scene, and of a lecture
"""
