"""The steps of a long model: what is alike is said once, and what would fill pages is given in names.

D, the Christoffel symbols and g are in the names of `explain.abbreviations`, the energies, the momenta and
the forces are formulas in d_ij, c_ijk and g_k (`explain.entry_formulas`); velocities and tensors of far links
stay the products they are, which would fill pages written out.

    general        what is said once for all links, bodies and coordinates
    inertia_entry  one entry of D worked out in full, body by body
    vectorized     D, the Christoffel symbols, C and g, one of each in full
"""
