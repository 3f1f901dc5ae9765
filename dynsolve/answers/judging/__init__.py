"""Comparing what a student wrote with the key, and with what the student's own answers lead to."""
