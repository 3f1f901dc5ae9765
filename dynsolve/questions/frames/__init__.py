"""The frames of a drawing, which is given in the place of a table."""
