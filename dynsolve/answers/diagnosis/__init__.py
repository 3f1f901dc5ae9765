"""The table of slips: what can go wrong, told to the person it happened to.

A slip is a record (`Slip`): its code, its kind in a few words, a message in the
second person that says what happened, and what to look at.  How a slip is
recognized stands in one of three files:

- `terms`: in single terms: a sign, a factor, a lost mass, square or dot;
- `steps`: a step of the derivation done otherwise from the student's own inputs;
- `changed_rules`: the whole derivation with one rule replaced.

To add a slip, write its record in `slips` with an example, and its recognition in
one of the three; the tests run every example.
"""
