; check: exit 1
; page 208235275 spindle and axis in turn (PUTAX, CALLAX)
; error K-0019 at 5:7
; error K-0019 at 9:7
N10 S[CALLAX]
N20 M03 S1000
N30 G04 X2
N40 M05
N50 S[PUTAX]
M30
