"""Exact expressions: the ring of polynomials in sines, cosines and symbols, and their compact form.

Arrows run one way, from the first of these files to the last:

- `rationals`, `angles`, `integer_basis`, `constants`: numbers, linear forms of angles, a
  basis of which every angle is an integer combination, cosines of constant angles;
- `contents`, `ring_plan`, `generators`: what formulas hold, what a ring must hold for
  them, and the variables of its polynomials in order;
- `relations`, `expr`, `ring`: s² + c² = 1 and the normal form, the elements, the ring with
  its derivatives; `floats`: values in floating point;
- `fraction`, `ring_values`, `build`, `matrix`: fractions, the value of a formula, making a
  ring, matrices; `transfer`: from one ring into another; `at_state`: values for coordinates;
- `sampling`: the values at which formulas are compared in numbers;
- `parameter_span`: combinations of unknown parameters over the fractions in known ones;
- `fraction_matrix`, `pseudoinverse`, `spans`: matrices of fractions, systems of linear
  equations, spaces;
- `inequality`: inequalities between parameters that follow from others;
- `minors`, `trig_factor`, `root_factor`, `positivity`: determinants, factors in sines and cosines,
  those of polynomials with square roots of numbers, what is positive by its form;
- `surds`, `surd_angles`, `surd_values`: sums of square roots, angles with such sines and cosines,
  the exact value of a formula of numbers;
- `fourier`, `compact`: the Fourier form, and what a textbook would print.

To add a kind of generator (a variable of the polynomials), name it in `generators.Generator`
and lay it out there, find the formulas that need it in `contents` and `ring_plan`, write its
relation in `relations`, its value in `ring_values` and `floats`, its derivative in `ring`.
"""
