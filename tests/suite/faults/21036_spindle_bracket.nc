; check: exit 1
; error 21036 at 3:10
S[REV100 REV200]
M30
