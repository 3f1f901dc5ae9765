"""A Denavit-Hartenberg table judged by the mechanism that it describes, not letter by letter.

tables        a table as it is written: cells, joint variables, numbers
chains        the joint axes that a table describes, without its frames
matching      whether two chains are one mechanism, for some choice of frames
comparison    a student's table against the key's, and how the student counts the coordinates
repairs       which cell of a wrong table is to blame
own_places    where the student's frames are, exactly, seen from the key's
restated      formulas of the exercise in the student's coordinates
own_frames    the robot in the student's frames, by which later answers are judged
wording       what is said of a table
"""
