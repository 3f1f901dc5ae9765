"""Reading answers: text and LaTeX as people write them -> trees in the symbols of the problem."""
