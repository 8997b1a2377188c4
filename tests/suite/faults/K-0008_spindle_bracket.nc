; check: exit 1
; error K-0008 at 3:10
S[REV100 REV200]
M30
