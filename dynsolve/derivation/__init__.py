"""The derivation, one file a section of the textbook; each function is one formula.

A stage computes and does nothing else: it takes exact values and returns exact
values.  How the functions hang together is `dynsolve.derivation.graph`; what a person
reads of them is made in `dynsolve.explain`.
"""
