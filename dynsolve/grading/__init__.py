"""Many hand-ins: from what the learning platform hands out to what it takes back.

    set_file            `set.yaml`: its keys and its schema, reading it; what is graded, how it is marked,
                        and who the members of a group are
    uploads, hand_ins   files, safely read -> who handed in what for which problem; who was given more days
    which_problem       for which problem a file is; a report on several, told apart by its headings
    run, fingerprints   what has to be computed; what has not is in the record
    pool                bounded processes, on this machine or on a Dask scheduler
    work                one hand-in there: its verdicts, its marks; the key of each answer for the queue
    record              everything that is known, in SQLite, and marks anew from it
    outputs, files      grades.csv, answers.csv and the students' pages, from the record; marks by hand
    cohort, queue_page  what waits for a human, and the page on which it is decided; what is counted of a
                        course, and how well its answers tell students apart
    teacher             the student's page, and the teacher's
    platforms/          what Canvas, Moodle and Gradescope hand out and import
    autograder/         dynsolve as an autograder of Gradescope
    public              `dynsolve.grade` and `dynsolve.override`

Nothing of a verdict is decided here; `dynsolve.answers` does that.  How to add a learning
platform stands in `platforms`; a rule of marking is a field of `answers.marks.Policy`,
described and read in `set_file` and applied in `answers.marks`.
"""
