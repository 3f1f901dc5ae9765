"""The grammar of answers."""
