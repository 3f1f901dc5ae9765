"""A Denavit-Hartenberg table judged by the mechanism that it describes, not letter by letter.

tables        a table as it is written, against the key's, and how the student counts the coordinates
matching      whether two chains of joint axes are one mechanism, for some choice of frames
own_frames    where the student's frames are, exactly, seen from the key's, and the robot in them, by which
              later answers are judged
"""
