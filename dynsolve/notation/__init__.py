"""Formulas as they are written: the tree, its readers and its printers.

`tree`: the classes of nodes, visiting a tree and rebuilding it.  `build`: sums and products as they are
written, and how many operations a formula has.  `differentiation`: derivatives term by term, and products
of sums multiplied out.

Read: `text` reads plain text and says what is wrong with it; `template` reads the formulas of the textbook
that steps are written with; `characters` says what names are made of and how they are set.  `size` measures
a tree before it is multiplied out, and bounds it for problem files.

Printed: `printing` is what all printers share, `formulas` what those of whole formulas share;
`unicode` and `python` are one notation each, `markup` is LaTeX, Typst and MathML.  `extent` measures how
wide a formula is when it is set; `rounding` marks what is printed rounded.  `tree_values` puts numbers into
trees.

To add a notation, derive a printer from `FormulaPrinter` (`formulas` says how).  To add a
kind of node, write its class in `tree` and its case in each printer; `tree.walk` knows its parts from its
fields.
"""
