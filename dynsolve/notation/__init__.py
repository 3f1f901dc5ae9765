"""Formulas as they are written: the tree, its readers and its printers."""
