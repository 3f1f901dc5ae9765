"""dynsolve as an autograder of Gradescope: students get their marks and their pages when they hand in.

    package  the zip that Gradescope is given: this program, a problem set, and the two scripts
    setup.sh        run once there, when the image is built: installs what dynsolve needs
    run_autograder  run there for every submission: starts the next
    __main__  judges the submission, and writes `results/results.json`

The layout is that of Gradescope's "Autograder Specifications" and "Submission Metadata"; everything lies
in /autograder, or where `AUTOGRADER_ROOT` says, so that it can be tried anywhere.
"""
