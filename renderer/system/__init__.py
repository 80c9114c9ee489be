"""The lowest layer: errors, atomic writing, child processes, memos."""
