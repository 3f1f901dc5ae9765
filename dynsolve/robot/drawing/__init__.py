"""From joint axes as a drawing shows them to a Denavit-Hartenberg table.

The textbook's procedure (Spong, Hutchinson, Vidyasagar 3.2; Craig 3.4): z along each joint
axis, x along the common normal of two axes that follow each other, the hand last.  Both
conventions fill their rows from the same normals, and differ in which of them shares a
row with which joint.

    angles      constant angles, found from exact cosines and sines
    normals     what is drawn, joint axes and the hand in one pose; the common normal of two lines; the
                normals
                along the arm, where free chosen as a textbook would
    rows        the rows of a table from the normals, and frame 0 in the world

Everything is exact.  Letters are positive and independent of each other: what vanishes for
some values of them alone does not count as zero.
"""
