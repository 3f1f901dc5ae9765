"""Numbers put for symbols: exact values, states of the robot, units.

Values are put into the exact ring, never as floating point: a robot with numbers is
a robot like any other, and what holds at a state is exact as well.  Decimals are made
only where a result is shown.

    given           assignments, `L1=0.4`, read and checked: values of parameters, a state; the unit of each
                    result
    substitution    exact values put into expressions and robots; exact results as decimals
    results         the results with values (`Valued`), at a state (`State`), and both (`Numbers`)
    blocks          which results are shown in numbers, and all of it as a part of a document

To show one more result in numbers, add it to its stage in `blocks`; what it is measured
in stands in its record in `dynsolve.quantities.families`.
"""
