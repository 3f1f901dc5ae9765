"""What a manipulator is.  Knows no file and no printing.

`model`: a `Robot` with its coordinates, its joints (the rows of a Denavit-Hartenberg table), its bodies,
also by their positions, given energies in their place, and what acts beside gravity; `actions`: the kinds of
that.  `questions`: what an exercise asks around this model and of its equations of motion, with what every
motion keeps and the matrices that are to be judged.  `shapes`: uniform bodies and their inertia.
`geometry`: rotations about axes, where the ends of a link are, and the sums of joint angles in which
formulas about parallel axes are short.  `dimensions`: what every symbol is measured in, by its role;
`units`: how dimensions and units are written.  `typed_sums`: the sums of a file that its formulas are
written with.  `names`: the names that are given beside those of a
problem.  `drawing`: joint axes as they are drawn, and the table that
the textbook's procedure makes of them.

To add a shape, write its record in `shapes`; to add a unit, its line in `units.KNOWN`.
"""
