"""What a student wrote, checked: tasks, right answers, the code in a process of its own, diagnosis."""
