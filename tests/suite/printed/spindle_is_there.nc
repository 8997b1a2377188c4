; run: exit 0
; page 15557113995 variables of spindles (V.SPDL), which spindles there are
N10 G90 Y0
N20 $IF EXIST[V.SPDL.LOG_AX_NR.S] == TRUE
N30 M3 S1000
N40 $ELSE
N50 #MSG ["there is no spindle S"]
N55 M0
N60 $ENDIF
M30
