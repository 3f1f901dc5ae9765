r"""The grammar of answers: prepared tokens -> a value, by recursive descent.

`formula.FormulaReader` is the descent: sums, products, factors, numbers (`0.10`, `90°`).  What stands in an
atom is read by the module that is named after it:

- `names` (symbols, running indices, z_0, a zero level of height), `references` (names of other answers, and
  the shorthand `c\theta_1`, `s_{12}`, `\sin 2\theta_1`, `cos^2(q1)`);
- `derivatives` (`∂L/∂q̇_1`, and what programs print: `Derivative(q1(t), t)`), `brackets` (parentheses and
  matrices).

They work on `reader.Reader`, the abstract base of the descent, which is a `scripts.ScriptCursor`
(names with their indices and exponents, kept as `scripts.Form` until they are looked up), which
is a `scripts.Cursor` (tokens, closing brackets, levels).  `scripts` makes powers, `reader` the derivatives of
values and expressions.

To read one more notation: a new spelling of a function or a bracket is a row in a table of its
module; a new kind of atom is a module with `read(reader)` and a branch in `FormulaReader.atom`,
`word` or `command`.
"""
