"""Numbers put for symbols: exact values, states of the robot, units.

Values are put into the exact ring, never as floating point: a robot with numbers is
a robot like any other, and what holds at a state is exact as well.  Decimals are made
only where a result is shown.

    assignments     `L1=0.4` as it was written, and where
    given           assignments read and checked: values of parameters, a state
    substitution    exact values put into expressions and robots
    results         the results with values (`Valued`), at a state (`State`), and both (`Numbers`)
    rounding        exact results as decimals
    selection       which results are shown in numbers, stage by stage
    measures        what each result is measured in: its dimension and its unit
    blocks          all of it as a part of a document

To show one more result in numbers, add it to its stage in `selection`; what it is measured
in stands in its record in `dynsolve.quantities.families`.
"""
