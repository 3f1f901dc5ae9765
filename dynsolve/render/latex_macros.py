"""What stands before a text in LaTeX: the page and its lengths, and the macros of what amsmath lacks."""

from __future__ import annotations

PREAMBLE = r"""\documentclass[a4paper]{article}
\usepackage{amsmath}
\setlength{\textwidth}{469pt}
\setlength{\oddsidemargin}{-8pt}
\setlength{\evensidemargin}{-8pt}
\setlength{\topmargin}{-60pt}
\setlength{\textheight}{757pt}
\setlength{\parindent}{0pt}
\setlength{\parskip}{3pt plus 1pt minus 1pt}
\setlength{\emergencystretch}{6em}
\setlength{\jot}{2pt}
\delimitershortfall=3pt % of brackets around a column of fractions
\setcounter{MaxMatrixCols}{30}
\renewcommand{\arraystretch}{1.12}
\clubpenalty=10000 \widowpenalty=10000
\AtBeginDocument{\setlength{\abovedisplayskip}{3pt plus 2pt minus 2pt}\belowdisplayskip=\abovedisplayskip
  \abovedisplayshortskip=\abovedisplayskip \belowdisplayshortskip=\belowdisplayskip}
\makeatletter
\renewcommand\section{\@startsection{section}{1}{0pt}{-12pt plus -4pt minus -4pt}{4pt}{\Large\bfseries}}
\renewcommand\subsection{\@startsection{subsection}{2}{0pt}{-8pt plus -3pt minus -3pt}{2pt}%
  {\normalsize\bfseries}}
\def\@listi{\leftmargin\leftmargini \topsep=3pt plus 2pt minus 2pt \parsep=0pt \itemsep=0pt}\let\@listI\@listi
\newcommand\contentsrow[2]{\@dottedtocline{1}{0pt}{1.6em}{#1}{\pageref{#2}}}
% A reference that the first run does not know is as wide as the last number: pages stay where they are.
\def\@setref#1#2#3{\ifx#1\relax\G@refundefinedtrue\theequation\@latex@warning{Reference `#3' undefined}%
  \else\expandafter#2#1\null\fi}
\makeatother
\pagestyle{myheadings}
"""

# The source of a formula; equations in columns: a row moved in, a cell of a width with its name and the rest;
# rows of a table that goes on, under its header where they begin a page;
# what closes a document, on a page of its own where it fills enough of that and little is left of one.
MACROS = r"""\providecommand{\formulasource}[1]{\footnotesize #1}
\providecommand{\equationrow}[2]{\par\noindent\strut\hspace*{#1\dimexpr\linewidth-3.4em\relax}#2}
\providecommand{\equationcell}[4]{\makebox[#1\dimexpr\linewidth-3.4em\relax][l]{%
  \makebox[#2em][r]{$\displaystyle #3$}$\displaystyle {}#4$}}
\providecommand{\equationnumber}[1]{\hfill\refstepcounter{equation}(\theequation)#1}
\ifdefined\tablerows\else\newsavebox\tablerows\fi
\providecommand{\tablepart}[3]{{\parskip=0pt\lineskip=0pt
  \setbox\tablerows=\hbox{\begin{tabular}{#1}#3\end{tabular}}%
  \ifdim\dimexpr\ht\tablerows+\dp\tablerows>\dimexpr\pagegoal-\pagetotal\relax \ifinner\else
  \ifdim\dimexpr\pagetotal-\pageshrink\relax>\pagegoal\else  % else what stands above goes there by itself
  \newpage\setbox\tablerows=\hbox{\begin{tabular}{#1}#2#3\end{tabular}}\fi\fi\fi
  {\centering\usebox\tablerows\par}}}
\ifdefined\closingpage\else\newsavebox\closingpage\fi
\providecommand{\putclosingpage}{\nobreak \ifdim\ht\closingpage>\textheight\else
  \ifdim\ht\closingpage>.25\textheight
  \ifdim\ht\closingpage>\dimexpr\pagegoal-\pagetotal\relax
  \ifdim\dimexpr\pagegoal-\pagetotal\relax<.35\textheight\newpage\fi\fi\fi\fi\unvbox\closingpage}
"""


NEEDS = r"""% Needs \usepackage{amsmath}, and where a matrix has more than ten columns
% \setcounter{MaxMatrixCols}{30}.
"""
