"""What a student wrote: reading it, comparing it, following it, diagnosing it."""
