"""Exact expressions: the trigonometric polynomial ring and its compact form."""
