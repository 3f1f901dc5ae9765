"""The steps of a long model: what is alike is said once, and what would fill pages is given in names.

D, the Christoffel symbols and g are in the names of `explain.abbreviations`, the energies,
the momenta and the forces are formulas in d_ij, c_ijk and g_k; velocities and tensors of far
links stay the products they are, which would fill pages written out.

    steps       the steps of a derivation, each changed by one of the files below, in their order
    model       what the changes are made from: the robot, its names, and d_ij, c_ijk and g_k by name
    general     what is said once for all links, bodies and coordinates
    frames      the last frame, and the axes of the others
    zero_pose   a check of the last frame with all joint angles 0
    halves      where a long product of frames is parted
    body_jacobians  the kinetic energy of a body, and the Jacobian of one worked out
    heights     the rows of rotations that give the heights of mass centres
    energies    the energies, the Lagrangian and the forces
    inertia_entry  one entry of D worked out in full
    body_share  what a body adds to an entry of D, by vectors along its axes
    slopes      one Christoffel symbol and one gravity term worked out in full
    name_slopes the derivatives of the names in a formula
    parallel_axes  why Christoffel symbols of joints with parallel axes are equal
    one_row     one row of τ in full
    vectorized  D, the Christoffel symbols, C and g
    sizes       which results would fill pages, and what stands in their place
"""
