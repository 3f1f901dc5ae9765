"""Many hand-ins: from what the learning platform hands out to what it takes back.

    set_keys, set_file      `set.yaml`: its keys and its schema, reading it
    problem_set             what is graded, and how it is marked
    uploads -> hand_ins     files, safely read -> who handed in what for which problem
    which_problem, sections for which problem a file is; a report on several, told apart by its headings
    run, fingerprints       what has to be computed; what has not is in the record
    rows                    what the record is told of a hand-in, judged or not
    pool, worker, cluster   bounded processes, on this machine or on a Dask scheduler
    work                    one hand-in there: its verdicts, its marks
    marking                 marks anew, from what the record keeps of each answer
    pages                   the student's page
    record                  everything that is known, in SQLite
    outputs, files          grades.csv, answers.csv and the students' pages, from the record
    queue, queue_page       what waits for a human, and the page on which it is decided
    key_forms, keys         the key of each answer, set for that page by a worker; in the record
    cohort, item_analysis   what is counted of a course, and how well its answers tell students apart
    teacher, histogram      the teacher's page
    copies                  what was handed in, where that page links to it
    by_hand, meant          a human's marks in bulk; which student is meant
    extensions, groups      who was given more days, and who the members of a group are
    listed                  reading these lists of the teacher's
    platforms/              what Canvas, Moodle and Gradescope hand out and import
    autograder/             dynsolve as an autograder of Gradescope
    public                  `dynsolve.grade` and `dynsolve.override`

Nothing of a verdict is decided here; `dynsolve.answers` does that.  How to add a learning
platform stands in `platforms`; a rule of marking is a field of
`answers.marking.policy.Policy`, described in `set_keys`, read in `set_file` and applied in
`answers.marking.marks`.
"""
