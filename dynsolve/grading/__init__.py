"""Many hand-ins: the run, the record, the reports, the platforms.

    problem set + uploads -> hand-ins (who, which problem, which files)
    hand-in -> verdicts, in a bounded worker -> marks -> the record (SQLite)
    the record -> grades.csv, answers.csv, feedback, report.html, the platforms' files

Nothing of a verdict is decided here; `dynsolve.answers` does that.  To add a learning
platform, add how its names are read to `platforms` and what it imports to `exports`.
"""
