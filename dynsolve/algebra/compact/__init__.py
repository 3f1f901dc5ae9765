"""From an exact value to what a textbook would print."""
