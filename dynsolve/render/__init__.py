"""Documents -> what a person sees.  A format lays out and computes nothing.

`page` is what all formats share; `terminal`, `latex`, `html`, `markdown` and `typst` (which
makes the PDF) are one format each, listed with their suffixes in `formats`.

Words: `prose` finds the mathematics among them, `latex_text` writes any text for LaTeX.
Formulas: `line_breaking` cuts them into pieces and these into lines, `parentheses` says how large those
around others are, `typesetting` sets a displayed formula to a width, `columns` sets many short equations
beside each other, `strokes` sets fractions among words, `matrices` gives a matrix that is too wide entry by
entry, `references` numbers formulas, `page_ends` says where a page may end, `latex_displays` writes
displayed formulas for LaTeX, `latex_macros` is what stands before the text there, `html_pieces` puts
formulas together for a browser, which ends the lines.
A terminal has cells in place of a font: `terminal_boxes`, `terminal_formulas`,
`terminal_breaking`.  `files` writes a file whole or not at all.

To add a format, derive its page from one in `page` and enter its name and suffixes in
`formats`; `.github/CONTRIBUTING.md` lists what else a format of reports needs.
"""
