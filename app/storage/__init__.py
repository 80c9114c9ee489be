"""What outlives the window: files that are opened and saved, sessions, recent files, pictures.

files           dialogs, dropped files, loading in the background
session         what was open, as text; session_store: where it is kept
"""
