"""Numbers put for symbols: exact values, states of the robot, units.

Values are put into the exact ring, never as floating point: a robot with numbers is
a robot like any other, and what holds at a state is exact as well.  Decimals are made
only where a result is shown.
"""
