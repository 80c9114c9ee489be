"""What everything stands on: errors, atomic writing, child processes, memos."""
