"""A Denavit-Hartenberg table judged by the mechanism that it describes, not letter by letter.

tables        a table as it is written, against the key's, and how the student counts the coordinates
matching      whether two chains of joint axes are one mechanism, for some choice of frames
repairs       which cell of a wrong table is to blame, and what is said of it
own_places    where the student's frames are, exactly, seen from the key's; formulas in the student's
              coordinates
own_frames    the robot in the student's frames, by which later answers are judged
"""
