"""What a manipulator is: joints, bodies, shapes.  Knows no file and no printing."""
