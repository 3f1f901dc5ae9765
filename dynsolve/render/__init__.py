"""Documents -> what a person sees.  A format lays out and computes nothing.

`page` is what all formats share, with fractions among words and where a page may end; `terminal`, `latex`,
`html`, `markdown` and `typst` (which makes the PDF) are one format each, listed with their suffixes in
`files`, which writes a file whole or not at all.

Words: `prose` finds the mathematics among them.
Formulas: `line_breaking` cuts them into pieces and these into lines, and numbers them; `typesetting` sets a
displayed formula to a width, or many short ones beside each other; `latex_displays` writes them for LaTeX;
`html` puts them together for a browser, which ends the lines; `terminal_boxes` lays them out in
the cells of a terminal, a matrix that is too wide entry by entry.

To add a format, derive its page from one in `page` and enter its name and suffixes in
`files`; `.github/CONTRIBUTING.md` lists what else a format of reports needs.
"""
