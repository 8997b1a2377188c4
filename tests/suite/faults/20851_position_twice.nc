; check: exit 1
; error 20851 at 3:20
S[M19 REV100 POS45 POS90]
M30
