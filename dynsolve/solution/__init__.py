"""What a Python user holds: a solution, its numbers, its forms as JSON, SymPy, NumPy and reports."""
