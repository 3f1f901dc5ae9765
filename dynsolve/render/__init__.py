"""Documents -> what a person sees.  A renderer lays out and computes nothing."""
