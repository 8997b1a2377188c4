; run: exit 1
; error K-0008 at 3:3
S[M3 REV100] M5
M30
