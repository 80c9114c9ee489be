"""What a student wrote, checked: tasks, right answers, its own process, the diagnosis."""
